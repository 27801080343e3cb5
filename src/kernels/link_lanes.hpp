// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// e_k of Eq. (1), squared, of eight links at a time. The same quantity as LinkResidual, in single
// precision and with one difference: what comes out is a quotient of sums of squares, so nothing
// cancels.
#pragma once

#include <algorithm>

#include "kernels/lanes.hpp"
#include "kernels/link_residual.hpp"

namespace mvo {

/// What a LinkResidual is made of.
struct LinkConstants {
  float fu = 0;
  float fv = 0;
  float focal_baseline = 0;
  float nearest = 0;           ///< smallest depth that can be seen, times 1 / (fu * baseline)
  float disparity_weight = 0;  ///< variance of u relative to that of the disparity
  ResidualModel model = ResidualModel::kWhitened;

  explicit LinkConstants(const LinkResidual& residual)
      : fu(static_cast<float>(residual.camera().fu)),
        fv(static_cast<float>(residual.camera().fv)),
        focal_baseline(static_cast<float>(residual.camera().fu * residual.camera().baseline)),
        nearest(static_cast<float>(LinkResidual::kNearest) / focal_baseline),
        disparity_weight(static_cast<float>(1.0 / residual.disparityVariance())),
        model(residual.model()) {}
};

/// A measurement as the lanes take it: where its ray pierces z = 1, and the disparity [px].
struct LinkPoint {
  float x = 0;
  float y = 0;
  float d = 0;

  LinkPoint(const StereoCamera& camera, const Eigen::Vector3d& measured)
      : x(static_cast<float>((measured.x() - camera.cu) / camera.fu)),
        y(static_cast<float>((measured.y() - camera.cv) / camera.fv)),
        d(static_cast<float>(measured.x() - measured.z())) {}
};

/// e_k^2 [px^2] of eight links; NaN where one of the arguments is. `T` is T_b_a, row by row, its
/// entries lanes or numbers; `from` and `seen` are the LinkPoints
/// in a and b.
template <typename M, ResidualModel kModel, typename Entry>
MVO_INLINE void squaredResidual(const LinkConstants& k, const Entry (&T)[12],
                                const Floats (&from)[3], const Floats (&seen)[3], Floats& e2) {
  constexpr auto kMinDisparity = static_cast<float>(LinkResidual::kMinDisparity);
  const Floats d = from[2] > kMinDisparity ? from[2] : Floats{} + kMinDisparity;
  const Floats w_a = d * (1.0F / k.focal_baseline);  // inverse depth in a
  const Floats r_x = fused<M>(T[0], from[0], T[1] * from[1]) + T[2];
  const Floats r_y = fused<M>(T[4], from[0], T[5] * from[1]) + T[6];
  const Floats r_z = fused<M>(T[8], from[0], T[9] * from[1]) + T[10];
  const Floats q_x = fused<M>(T[3], w_a, r_x);
  const Floats q_y = fused<M>(T[7], w_a, r_y);
  const Floats q_z = fused<M>(T[11], w_a, r_z);  // the depth in b over that in a
  const Floats s = 1.0F / q_z;
  Floats result;
  if (kModel == ResidualModel::kImageDistance) {
    const Floats e_u = k.fu * fused<M>(-s, q_x, seen[0]);
    const Floats e_v = k.fv * fused<M>(-s, q_y, seen[1]);
    result = fused<M>(e_u, e_u, e_v * e_v);
  } else {
    // The covariance of (e_u, e_v, e_d) is diag(q, q, 1 / m) + j j^T / (m d^2), j being the
    // derivative along the ray times d; its inverse by Sherman and Morrison, squares collected.
    const Floats x = q_x * s;
    const Floats y = q_y * s;
    const Floats e_u = k.fu * (seen[0] - x);
    const Floats e_v = k.fv * (seen[1] - y);
    const Floats e_d = seen[2] - d * s;
    const Floats j_u = k.fu * s * fused<M>(x, r_z, -r_x);
    const Floats j_v = k.fv * s * fused<M>(y, r_z, -r_y);
    const Floats j_d = d * s * s * r_z;
    const Floats q = fused<M>(s, s, M::all(1.0F));
    const Floats m_q = k.disparity_weight * q;
    const Floats c_uv = fused<M>(e_u, j_v, -(e_v * j_u));
    const Floats c_ud = fused<M>(e_u, j_d, -(e_d * j_u));
    const Floats c_vd = fused<M>(e_v, j_d, -(e_d * j_v));
    const Floats d2 = d * d;
    Floats squares = fused<M>(fused<M>(e_u, e_u, e_v * e_v), d2, c_ud * c_ud);
    squares = fused<M>(c_vd, c_vd, squares);
    squares = fused<M>(m_q * d2 * e_d, e_d, squares);
    const Floats numerator = fused<M>(c_uv, c_uv, m_q * squares);
    const Floats norm = fused<M>(m_q, fused<M>(j_d, j_d, d2), fused<M>(j_u, j_u, j_v * j_v));
    result = 2.0F * numerator / (q * norm);
  }
  constexpr auto kBehind2 = static_cast<float>(LinkResidual::kBehind * LinkResidual::kBehind);
  e2 = q_z < k.nearest * d ? Floats{} + kBehind2 : result;
}

}  // namespace mvo
