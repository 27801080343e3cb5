// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/link_equations.hpp"

#include <algorithm>

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

constexpr int kFields = 7;  // ray in a (x, y, disparity), what b sees (u, v, disparity), weight
constexpr int kBlock = kFields * kDoubles;
constexpr int kTriangle = LinkEquations::kTriangle;

struct Constants {
  double fu, fv, focal_baseline, ratio2;
  double T[12];  // T_b_a, row by row
  double inverse_scale2;
};

// a b - c d.
template <typename M>
MVO_INLINE Doubles difference(Doubles a, Doubles b, Doubles c, Doubles d) {
  return fused<M>(a, b, -(c * d));
}

// A link's residual e, the point p in b, the Jacobian S = (a, 0, -a x; 0, b, -b y; 0, 0, c) of its
// image, and the information 2 (diag(i_uv, i_uv, i_d) - h h^T inverse_norm).
struct Lanes {
  Doubles p_x, p_y, p_z;
  Doubles e_u, e_v, e_d;
  Doubles a, b, c, x, y;
  Doubles i_uv, h_u, h_v, h_d, inverse_norm;
  double i_d;
  Doubles is_ahead;  // 1, or 0 behind the camera
};

template <typename M>
MVO_INLINE Lanes linearize(const Constants& k, const Doubles* field) {
  const Doubles one = M::all(1.0);
  const Doubles d = field[2];
  const Doubles z_a = k.focal_baseline / d;
  const Doubles r_x = fused<M>(field[0], k.T[0], k.T[1] * field[1]) + k.T[2];  // over z_a
  const Doubles r_y = fused<M>(field[0], k.T[4], k.T[5] * field[1]) + k.T[6];
  const Doubles r_z = (fused<M>(field[0], k.T[8], k.T[9] * field[1]) + k.T[10]) * z_a;
  Lanes l;
  l.p_x = fused<M>(z_a, r_x, M::all(k.T[3]));
  l.p_y = fused<M>(z_a, r_y, M::all(k.T[7]));
  const Doubles depth = r_z + k.T[11];
  const auto behind = depth < LinkResidual::kNearest;
  l.is_ahead = behind ? Doubles{} : one;
  l.p_z = behind ? one : depth;
  const Doubles w = 1.0 / l.p_z;
  l.x = l.p_x * w;
  l.y = l.p_y * w;
  l.e_u = fused<M>(-l.x, k.fu, field[3]);
  l.e_v = fused<M>(-l.y, k.fv, field[4]);
  l.e_d = fused<M>(-w, k.focal_baseline, field[5]);
  l.a = k.fu * w;
  l.b = k.fv * w;
  l.c = -k.focal_baseline * w * w;
  // The covariance is D + ratio^2 j j^T: noise of both images, and the first disparity's, which
  // acts along the ray. Its inverse by Sherman and Morrison.
  const Doubles scale = z_a * w;
  l.i_uv = 1.0 / fused<M>(scale, scale, one);
  l.i_d = 1.0 / k.ratio2;
  const Doubles j_u = -l.a * difference<M>(z_a, r_x, l.x, r_z) / d;
  const Doubles j_v = -l.b * difference<M>(z_a, r_y, l.y, r_z) / d;
  const Doubles j_d = -l.c * r_z / d;
  l.h_u = l.i_uv * j_u;
  l.h_v = l.i_uv * j_v;
  l.h_d = l.i_d * j_d;
  const Doubles norm = fused<M>(j_v, l.h_v, fused<M>(j_u, l.h_u, M::all(l.i_d)));
  l.inverse_norm = 1.0 / fused<M>(j_d, l.h_d, norm);
  return l;
}

// S^T times a vector (u, v, d).
template <typename M>
MVO_INLINE Doubles projected(const Lanes& l, Doubles u, Doubles v, Doubles d) {
  return fused<M>(-(l.b * l.y), v, difference<M>(l.c, d, l.a * l.x, u));
}

// m = S^T W e and M = S^T W S, W being the information times Cauchy's weight.
struct Moments {
  Doubles x, y, z;
  Doubles xx, xy, xz, yy, yz, zz;
};

template <typename M>
MVO_INLINE Moments momentsOf(const Constants& k, const Lanes& l, Doubles weight) {
  const Doubles along_e = fused<M>(l.e_d, l.h_d, fused<M>(l.h_u, l.e_u, l.h_v * l.e_v));
  const Doubles along = along_e * l.inverse_norm;
  const Doubles f_u = 2.0 * difference<M>(l.i_uv, l.e_u, l.h_u, along);
  const Doubles f_v = 2.0 * difference<M>(l.i_uv, l.e_v, l.h_v, along);
  const Doubles f_d = 2.0 * difference<M>(M::all(l.i_d), l.e_d, l.h_d, along);
  const Doubles e2 = fused<M>(l.e_d, f_d, fused<M>(l.e_u, f_u, l.e_v * f_v));
  const Doubles cauchy = weight / fused<M>(e2, k.inverse_scale2, M::all(1.0));
  const Doubles w = l.is_ahead > 0.5 ? cauchy : Doubles{};
  Moments m;
  m.x = w * l.a * f_u;
  m.y = w * l.b * f_v;
  m.z = w * projected<M>(l, f_u, f_v, f_d);
  const Doubles g_x = l.a * l.h_u;
  const Doubles g_y = l.b * l.h_v;
  const Doubles g_z = projected<M>(l, l.h_u, l.h_v, l.h_d);
  const Doubles v = 2.0 * w;
  const Doubles n = v * l.inverse_norm;
  const Doubles n_x = n * g_x;
  const Doubles n_y = n * g_y;
  const Doubles aa = v * l.i_uv * l.a * l.a;
  const Doubles bb = v * l.i_uv * l.b * l.b;
  m.xx = fused<M>(-n_x, g_x, aa);
  m.xy = -n_x * g_y;
  m.xz = fused<M>(-n_x, g_z, -aa * l.x);
  m.yy = fused<M>(-n_y, g_y, bb);
  m.yz = fused<M>(-n_y, g_z, -bb * l.y);
  const Doubles zz = fused<M>(aa * l.x, l.x, bb * l.y * l.y);
  m.zz = fused<M>(-(n * g_z), g_z, fused<M>(v * l.i_d * l.c, l.c, zz));
  return m;
}

// A pair's Jacobian is S [1, -p^], so its part of the equations follows from M, m and N = p^ M.
template <typename M>
MVO_INLINE void addPair(const Lanes& l, const Moments& m, Doubles* sum) {
  const Doubles z_xy = l.p_z * m.xy;
  const Doubles x_yz = l.p_x * m.yz;
  const Doubles n_xx = fused<M>(l.p_y, m.xz, -z_xy);
  const Doubles n_xy = difference<M>(l.p_y, m.yz, l.p_z, m.yy);
  const Doubles n_xz = difference<M>(l.p_y, m.zz, l.p_z, m.yz);
  const Doubles n_yx = difference<M>(l.p_z, m.xx, l.p_x, m.xz);
  const Doubles n_yy = z_xy - x_yz;
  const Doubles n_yz = difference<M>(l.p_z, m.xz, l.p_x, m.zz);
  const Doubles n_zx = difference<M>(l.p_x, m.xy, l.p_y, m.xx);
  const Doubles n_zy = difference<M>(l.p_x, m.yy, l.p_y, m.xy);
  const Doubles n_zz = fused<M>(-l.p_y, m.xz, x_yz);
  const Doubles terms[kTriangle + 6] = {m.xx,
                                        m.xy,
                                        m.yy,
                                        m.xz,
                                        m.yz,
                                        m.zz,
                                        n_xx,
                                        n_xy,
                                        n_xz,
                                        difference<M>(l.p_y, n_xz, l.p_z, n_xy),  // and N (p^)^T
                                        n_yx,
                                        n_yy,
                                        n_yz,
                                        difference<M>(l.p_y, n_yz, l.p_z, n_yy),
                                        difference<M>(l.p_z, n_yx, l.p_x, n_yz),
                                        n_zx,
                                        n_zy,
                                        n_zz,
                                        difference<M>(l.p_y, n_zz, l.p_z, n_zy),
                                        difference<M>(l.p_z, n_zx, l.p_x, n_zz),
                                        difference<M>(l.p_x, n_zy, l.p_y, n_zx),
                                        m.x,
                                        m.y,
                                        m.z,
                                        difference<M>(l.p_y, m.z, l.p_z, m.y),
                                        difference<M>(l.p_z, m.x, l.p_x, m.z),
                                        difference<M>(l.p_x, m.y, l.p_y, m.x)};
  for (int i = 0; i < kTriangle + 6; ++i) sum[i] += terms[i];
}

template <typename M>
MVO_INLINE void addBlocks(const Constants& k, const double* data, int blocks, double* equations) {
  Doubles sums[kTriangle + 6] = {};
  for (int i = 0; i < blocks; ++i, data += kBlock) {
    const auto* field = reinterpret_cast<const Doubles*>(data);
    const Lanes l = linearize<M>(k, field);
    addPair<M>(l, momentsOf<M>(k, l, field[6]), sums);
  }
  for (int i = 0; i < kTriangle + 6; ++i)
    equations[i] = (sums[i][0] + sums[i][1]) + (sums[i][2] + sums[i][3]);
}

}  // namespace

LinkEquations::LinkEquations(const LinkResidual& residual)
    : camera_(residual.camera()), ratio2_(residual.disparityVariance()) {}

void LinkEquations::add(const StereoPair& pair) {
  const std::size_t block = pairs_ / kDoubles;
  const int lane = pairs_ % kDoubles;
  if (data_.size() < (block + 1) * kBlock) data_.resize((block + 1) * kBlock);
  const std::array<double, kFields> fields = {
      (pair.y_a.x() - camera_.cu) / camera_.fu,
      (pair.y_a.y() - camera_.cv) / camera_.fv,
      std::max(pair.y_a.x() - pair.y_a.z(), LinkResidual::kMinDisparity),
      pair.y_b.x() - camera_.cu,
      pair.y_b.y() - camera_.cv,
      pair.y_b.x() - pair.y_b.z(),
      1.0};
  // What follows in the block repeats this pair without weight, until it is overwritten.
  for (int i = lane; i < kDoubles; ++i)
    for (int f = 0; f < kFields; ++f)
      data_[block * kBlock + f * kDoubles + i] = f == kFields - 1 && i > lane ? 0.0 : fields[f];
  ++pairs_;
}

LinkEquations::Equations LinkEquations::at(const Eigen::Isometry3d& T_b_a, double scale) const {
  Constants k{camera_.fu, camera_.fv, camera_.fu * camera_.baseline,
              ratio2_,    {},         1 / (scale * scale)};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) k.T[4 * row + column] = T_b_a(row, column);
  Equations equations;
  const int blocks = (pairs_ + kDoubles - 1) / kDoubles;
  onThisMachine([&](auto machine) MVO_KERNEL {
    addBlocks<decltype(machine)>(k, data_.data(), blocks, equations.data());
  });
  return equations;
}

}  // namespace mvo
