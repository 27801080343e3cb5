// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Eq. (1) of one link, for a number or for lanes: its squared residual alone, and the residual with
// all that a Gauss-Newton step needs. The first collects squares, so nothing cancels in single
// precision.
#pragma once

#include "kernels/lanes.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

constexpr double kLinkBehind = 1e3;    ///< e_k of a point behind the camera [px]
constexpr double kLinkNearest = 1e-2;  ///< smallest depth that can be seen [m]
/// Of a measurement; farther points are as good as infinitely far [px].
constexpr double kLeastDisparity = 0.05;

/// What links are computed in: `Number` is one link's or several links' numbers of type Scalar.
struct OneLink {
  using Scalar = double;
  using Number = double;
  template <typename M>
  static MVO_INLINE Number all(Scalar x) {
    return x;
  }
};
struct FourLinks {
  using Scalar = double;
  using Number = Doubles;
  template <typename M>
  static MVO_INLINE Number all(Scalar x) {
    return M::all(x);
  }
};
struct EightLinks {
  using Scalar = float;
  using Number = Floats;
  template <typename M>
  static MVO_INLINE Number all(Scalar x) {
    return M::all(x);
  }
};

/// The camera and its noise, as the formulas take them.
template <typename N>
struct LinkConstants {
  using Scalar = typename N::Scalar;
  Scalar fu = 0;
  Scalar fv = 0;
  Scalar focal_baseline = 0;
  Scalar nearest = 0;           ///< smallest depth that can be seen, times 1 / (fu * baseline)
  Scalar disparity_weight = 0;  ///< variance of u relative to that of the disparity

  /// disparity_variance is relative to that of u.
  LinkConstants(const StereoCamera& camera, double disparity_variance)
      : fu(static_cast<Scalar>(camera.fu)),
        fv(static_cast<Scalar>(camera.fv)),
        focal_baseline(static_cast<Scalar>(camera.fu * camera.baseline)),
        nearest(static_cast<Scalar>(kLinkNearest) / focal_baseline),
        disparity_weight(static_cast<Scalar>(1.0 / disparity_variance)) {}
};

/// A measurement: where its ray pierces z = 1, and the disparity [px].
template <typename N>
struct LinkPoint {
  using Scalar = typename N::Scalar;
  Scalar x = 0;
  Scalar y = 0;
  Scalar d = 0;

  LinkPoint(const StereoCamera& camera, const Eigen::Vector3d& measured)
      : x(static_cast<Scalar>((measured.x() - camera.cu) / camera.fu)),
        y(static_cast<Scalar>((measured.y() - camera.cv) / camera.fv)),
        d(static_cast<Scalar>(measured.x() - measured.z())) {}
};

/// e_k^2 [px^2]; NaN where one of the arguments is. `T` is T_b_a, row by row, its entries lanes or
/// numbers; `from` and `seen` are the LinkPoints in a and b.
template <typename M, typename N, ResidualModel kModel, typename Entry>
MVO_INLINE void squaredResidual(const LinkConstants<N>& k, const Entry (&T)[12],
                                const typename N::Number (&from)[3],
                                const typename N::Number (&seen)[3], typename N::Number& e2) {
  using Number = typename N::Number;
  using Scalar = typename N::Scalar;
  constexpr Scalar one = 1;
  constexpr auto kMinDisparity = static_cast<Scalar>(kLeastDisparity);
  const Number d = from[2] > kMinDisparity ? from[2] : Number{} + kMinDisparity;
  const Number w_a = d * (one / k.focal_baseline);  // inverse depth in a
  const Number r_x = fused<M>(T[0], from[0], T[1] * from[1]) + T[2];
  const Number r_y = fused<M>(T[4], from[0], T[5] * from[1]) + T[6];
  const Number r_z = fused<M>(T[8], from[0], T[9] * from[1]) + T[10];
  const Number q_x = fused<M>(T[3], w_a, r_x);
  const Number q_y = fused<M>(T[7], w_a, r_y);
  const Number q_z = fused<M>(T[11], w_a, r_z);  // the depth in b over that in a
  const Number s = one / q_z;
  Number result;
  if constexpr (kModel == ResidualModel::kImageDistance) {
    const Number e_u = k.fu * fused<M>(-s, q_x, seen[0]);
    const Number e_v = k.fv * fused<M>(-s, q_y, seen[1]);
    result = fused<M>(e_u, e_u, e_v * e_v);
  } else {
    // The covariance of (e_u, e_v, e_d) is diag(q, q, 1 / m) + j j^T / (m d^2), j being the
    // derivative along the ray times d; its inverse by Sherman and Morrison, squares collected.
    const Number x = q_x * s;
    const Number y = q_y * s;
    const Number e_u = k.fu * (seen[0] - x);
    const Number e_v = k.fv * (seen[1] - y);
    const Number e_d = seen[2] - d * s;
    const Number j_u = k.fu * s * fused<M>(x, r_z, -r_x);
    const Number j_v = k.fv * s * fused<M>(y, r_z, -r_y);
    const Number j_d = d * s * s * r_z;
    const Number q = fused<M>(s, s, N::template all<M>(one));
    const Number m_q = k.disparity_weight * q;
    const Number c_uv = fused<M>(e_u, j_v, -(e_v * j_u));
    const Number c_ud = fused<M>(e_u, j_d, -(e_d * j_u));
    const Number c_vd = fused<M>(e_v, j_d, -(e_d * j_v));
    const Number d2 = d * d;
    Number squares = fused<M>(fused<M>(e_u, e_u, e_v * e_v), d2, c_ud * c_ud);
    squares = fused<M>(c_vd, c_vd, squares);
    squares = fused<M>(m_q * d2 * e_d, e_d, squares);
    const Number numerator = fused<M>(c_uv, c_uv, m_q * squares);
    const Number norm = fused<M>(m_q, fused<M>(j_d, j_d, d2), fused<M>(j_u, j_u, j_v * j_v));
    result = Scalar{2} * numerator / (q * norm);
  }
  constexpr auto kBehind2 = static_cast<Scalar>(kLinkBehind * kLinkBehind);
  e2 = q_z < k.nearest * d ? Number{} + kBehind2 : result;
}

/// A link's residual e = (e_u, e_v, e_d) [px], the point p in b [m], the Jacobian
/// S = (a, 0, -a x; 0, b, -b y; 0, 0, c) of its image, and the information
/// 2 (diag(i_uv, i_uv, i_d) - h h^T inverse_norm) of e, in units of the noise of u.
template <typename N>
struct LinearLink {
  using Number = typename N::Number;
  Number p_x, p_y, p_z;
  Number e_u, e_v, e_d;
  Number a, b, c, x, y;
  Number i_uv, h_u, h_v, h_d, inverse_norm;
  typename N::Scalar i_d;
  Number is_ahead;  ///< 1, or 0 behind the camera, where all else is finite and without meaning
};

/// `seen` is (u, v, disparity) in b, from the principal point on [px]; else as squaredResidual().
template <typename M, typename N>
MVO_INLINE LinearLink<N> linearizeLink(const LinkConstants<N>& k, const typename N::Scalar (&T)[12],
                                       const typename N::Number (&from)[3],
                                       const typename N::Number (&seen)[3]) {
  using Number = typename N::Number;
  const Number one = N::template all<M>(1);
  const Number d = from[2];
  const Number z_a = k.focal_baseline / d;
  const Number r_x = fused<M>(from[0], T[0], T[1] * from[1]) + T[2];  // over z_a
  const Number r_y = fused<M>(from[0], T[4], T[5] * from[1]) + T[6];
  const Number r_z = (fused<M>(from[0], T[8], T[9] * from[1]) + T[10]) * z_a;
  LinearLink<N> l;
  l.p_x = fused<M>(z_a, r_x, N::template all<M>(T[3]));
  l.p_y = fused<M>(z_a, r_y, N::template all<M>(T[7]));
  const Number depth = r_z + T[11];
  const auto behind = depth < kLinkNearest;
  l.is_ahead = behind ? Number{} : one;
  l.p_z = behind ? one : depth;
  const Number w = 1.0 / l.p_z;
  l.x = l.p_x * w;
  l.y = l.p_y * w;
  l.e_u = fused<M>(-l.x, k.fu, seen[0]);
  l.e_v = fused<M>(-l.y, k.fv, seen[1]);
  l.e_d = fused<M>(-w, k.focal_baseline, seen[2]);
  l.a = k.fu * w;
  l.b = k.fv * w;
  l.c = -k.focal_baseline * w * w;
  // The covariance is D + ratio^2 j j^T: noise of both images, and the first disparity's, which
  // acts along the ray (dp/dd = -p/d). Its inverse by Sherman and Morrison.
  const Number scale = z_a * w;
  l.i_uv = 1.0 / fused<M>(scale, scale, one);
  l.i_d = k.disparity_weight;
  const Number j_u = -l.a * fused<M>(z_a, r_x, -(l.x * r_z)) / d;
  const Number j_v = -l.b * fused<M>(z_a, r_y, -(l.y * r_z)) / d;
  const Number j_d = -l.c * r_z / d;
  l.h_u = l.i_uv * j_u;
  l.h_v = l.i_uv * j_v;
  l.h_d = l.i_d * j_d;
  const Number norm = fused<M>(j_v, l.h_v, fused<M>(j_u, l.h_u, N::template all<M>(l.i_d)));
  l.inverse_norm = 1.0 / fused<M>(j_d, l.h_d, norm);
  return l;
}

}  // namespace mvo
