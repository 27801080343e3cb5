// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/link_equations.hpp"

#include <algorithm>

#include "kernels/lanes.hpp"
#include "kernels/link.hpp"

namespace mvo {

namespace {

constexpr int kFields = 7;  // ray in a (x, y, disparity), what b sees (u, v, disparity), weight
constexpr int kBlock = kFields * kDoubles;
constexpr int kTriangle = LinkEquations::kTriangle;

struct Constants {
  LinkConstants<FourLinks> camera;
  double T[12];  // T_b_a, row by row
  double inverse_scale2;
};

// a b - c d.
template <typename M>
MVO_INLINE Doubles difference(Doubles a, Doubles b, Doubles c, Doubles d) {
  return fused<M>(a, b, -(c * d));
}

using Lanes = LinearLink<FourLinks>;

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
    const Lanes l = linearizeLink<M, FourLinks>(k.camera, k.T, {field[0], field[1], field[2]},
                                                {field[3], field[4], field[5]});
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
      std::max(pair.y_a.x() - pair.y_a.z(), kLeastDisparity),
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
  Constants k{{camera_, ratio2_}, {}, 1 / (scale * scale)};
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
