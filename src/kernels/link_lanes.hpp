// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// e_k of Eq. (1), squared, of eight links at a time. The same quantity as LinkResidual, in single
// precision and with one difference: what comes out is a quotient of sums of squares, so nothing
// cancels.
#pragma once

#include <algorithm>

#include "engine/link_residual.hpp"

namespace mvo {

constexpr int kLanes = 8;

/// Eight floats anywhere in memory; the compiler makes of them what the target has.
using Lanes = float __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));
using LaneMask = int __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));

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
template <ResidualModel kModel, typename Entry>
__attribute__((always_inline)) inline void squaredResidual(const LinkConstants& k,
                                                           const Entry (&T)[12],
                                                           const Lanes (&from)[3],
                                                           const Lanes (&seen)[3], Lanes& e2) {
  constexpr auto kMinDisparity = static_cast<float>(LinkResidual::kMinDisparity);
  const Lanes d = from[2] > kMinDisparity ? from[2] : Lanes{} + kMinDisparity;
  const Lanes w_a = d * (1.0F / k.focal_baseline);  // inverse depth in a
  const Lanes r_x = T[0] * from[0] + T[1] * from[1] + T[2];
  const Lanes r_y = T[4] * from[0] + T[5] * from[1] + T[6];
  const Lanes r_z = T[8] * from[0] + T[9] * from[1] + T[10];
  const Lanes q_z = r_z + T[11] * w_a;  // the depth in b over that in a
  const Lanes s = 1.0F / q_z;
  const Lanes x = (r_x + T[3] * w_a) * s;
  const Lanes y = (r_y + T[7] * w_a) * s;
  const Lanes e_u = k.fu * (seen[0] - x);
  const Lanes e_v = k.fv * (seen[1] - y);
  Lanes result = e_u * e_u + e_v * e_v;
  if (kModel == ResidualModel::kWhitened) {
    // The covariance of (e_u, e_v, e_d) is diag(q, q, 1 / m) + j j^T / (m d^2), j being the
    // derivative along the ray times d; its inverse by Sherman and Morrison, squares collected.
    const Lanes e_d = seen[2] - d * s;
    const Lanes j_u = k.fu * s * (x * r_z - r_x);
    const Lanes j_v = k.fv * s * (y * r_z - r_y);
    const Lanes j_d = d * s * s * r_z;
    const Lanes q = 1.0F + s * s;
    const Lanes m_q = k.disparity_weight * q;
    const Lanes c_uv = e_u * j_v - e_v * j_u;
    const Lanes c_ud = e_u * j_d - e_d * j_u;
    const Lanes c_vd = e_v * j_d - e_d * j_v;
    const Lanes d2 = d * d;
    const Lanes numerator =
        c_uv * c_uv + m_q * (result * d2 + c_ud * c_ud + c_vd * c_vd + m_q * d2 * e_d * e_d);
    const Lanes denominator = q * (j_u * j_u + j_v * j_v + m_q * (d2 + j_d * j_d));
    result = 2.0F * numerator / denominator;
  }
  constexpr auto kBehind2 = static_cast<float>(LinkResidual::kBehind * LinkResidual::kBehind);
  e2 = q_z < k.nearest * d ? Lanes{} + kBehind2 : result;
}

}  // namespace mvo
