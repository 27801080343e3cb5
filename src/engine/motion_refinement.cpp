// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/motion_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kernels/lanes.hpp"
#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr int kFields = 7;  // ray in a (x, y, disparity), what b sees (u, v, disparity), weight
constexpr int kBlock = kFields * kDoubles;

struct Constants {
  double fu, fv, focal_baseline, ratio2;
  double T[12];  // T_b_a, row by row
  double inverse_scale2;
};

// A's lower triangle, row by row, and b of A step = b.
constexpr int kTriangle = 21;
using Equations = std::array<double, kTriangle + 6>;

// The normal equations of all blocks. With p the point in b and S the Jacobian of its image, a
// pair's Jacobian is S [1, -p^], so all follows from M = S^T W S and m = S^T W e.
MVO_INLINE void addBlocks(const Constants& k, const double* data, int blocks, double* equations) {
  Doubles sum[kTriangle + 6] = {};
  for (int i = 0; i < blocks; ++i, data += kBlock) {
    const auto* field = reinterpret_cast<const Doubles*>(data);
    const Doubles d = field[2];
    const Doubles z_a = k.focal_baseline / d;
    const Doubles r_x = (k.T[0] * field[0] + k.T[1] * field[1] + k.T[2]) * z_a;
    const Doubles r_y = (k.T[4] * field[0] + k.T[5] * field[1] + k.T[6]) * z_a;
    const Doubles r_z = (k.T[8] * field[0] + k.T[9] * field[1] + k.T[10]) * z_a;
    const Doubles one = Doubles{} + 1.0;
    const Doubles p_x = r_x + k.T[3];
    const Doubles p_y = r_y + k.T[7];
    const Doubles depth = r_z + k.T[11];
    const auto behind = depth < LinkResidual::kNearest;
    const Doubles p_z = behind ? one : depth;
    const Doubles w = 1.0 / p_z;
    const Doubles x = p_x * w;
    const Doubles y = p_y * w;
    const Doubles e_u = field[3] - k.fu * x;
    const Doubles e_v = field[4] - k.fv * y;
    const Doubles e_d = field[5] - k.focal_baseline * w;

    // S = (a, 0, -a x; 0, b, -b y; 0, 0, c).
    const Doubles a = k.fu * w;
    const Doubles b = k.fv * w;
    const Doubles c = -k.focal_baseline * w * w;
    const Doubles scale = z_a * w;
    const Doubles i_uv = 1.0 / (1.0 + scale * scale);
    const double i_d = 1.0 / k.ratio2;
    const Doubles j_u = -a * (r_x - x * r_z) / d;
    const Doubles j_v = -b * (r_y - y * r_z) / d;
    const Doubles j_d = -c * r_z / d;
    const Doubles h_u = i_uv * j_u;
    const Doubles h_v = i_uv * j_v;
    const Doubles h_d = i_d * j_d;
    const Doubles inverse_norm = 1.0 / (i_d + j_u * h_u + j_v * h_v + j_d * h_d);
    const Doubles along = (h_u * e_u + h_v * e_v + h_d * e_d) * inverse_norm;
    const Doubles f_u = 2.0 * (i_uv * e_u - h_u * along);
    const Doubles f_v = 2.0 * (i_uv * e_v - h_v * along);
    const Doubles f_d = 2.0 * (i_d * e_d - h_d * along);
    const Doubles e2 = e_u * f_u + e_v * f_v + e_d * f_d;
    const Doubles weight = behind ? Doubles{} : field[6] / (1.0 + e2 * k.inverse_scale2);  // Cauchy

    const Doubles m_x = weight * a * f_u;
    const Doubles m_y = weight * b * f_v;
    const Doubles m_z = weight * (c * f_d - a * x * f_u - b * y * f_v);
    const Doubles g_x = a * h_u;
    const Doubles g_y = b * h_v;
    const Doubles g_z = c * h_d - a * x * h_u - b * y * h_v;
    const Doubles v = 2.0 * weight;
    const Doubles n = v * inverse_norm;
    const Doubles aa = v * i_uv * a * a;
    const Doubles bb = v * i_uv * b * b;
    const Doubles m_xx = aa - n * g_x * g_x;
    const Doubles m_xy = -n * g_x * g_y;
    const Doubles m_xz = -aa * x - n * g_x * g_z;
    const Doubles m_yy = bb - n * g_y * g_y;
    const Doubles m_yz = -bb * y - n * g_y * g_z;
    const Doubles m_zz = aa * x * x + bb * y * y + v * i_d * c * c - n * g_z * g_z;
    // N = p^ M.
    const Doubles n_xx = p_y * m_xz - p_z * m_xy;
    const Doubles n_xy = p_y * m_yz - p_z * m_yy;
    const Doubles n_xz = p_y * m_zz - p_z * m_yz;
    const Doubles n_yx = p_z * m_xx - p_x * m_xz;
    const Doubles n_yy = p_z * m_xy - p_x * m_yz;
    const Doubles n_yz = p_z * m_xz - p_x * m_zz;
    const Doubles n_zx = p_x * m_xy - p_y * m_xx;
    const Doubles n_zy = p_x * m_yy - p_y * m_xy;
    const Doubles n_zz = p_x * m_yz - p_y * m_xz;
    sum[0] += m_xx;
    sum[1] += m_xy;
    sum[2] += m_yy;
    sum[3] += m_xz;
    sum[4] += m_yz;
    sum[5] += m_zz;
    sum[6] += n_xx;
    sum[7] += n_xy;
    sum[8] += n_xz;
    sum[10] += n_yx;
    sum[11] += n_yy;
    sum[12] += n_yz;
    sum[15] += n_zx;
    sum[16] += n_zy;
    sum[17] += n_zz;
    // N (p^)^T.
    sum[9] += p_y * n_xz - p_z * n_xy;
    sum[13] += p_y * n_yz - p_z * n_yy;
    sum[14] += p_z * n_yx - p_x * n_yz;
    sum[18] += p_y * n_zz - p_z * n_zy;
    sum[19] += p_z * n_zx - p_x * n_zz;
    sum[20] += p_x * n_zy - p_y * n_zx;
    sum[21] += m_x;
    sum[22] += m_y;
    sum[23] += m_z;
    sum[24] += p_y * m_z - p_z * m_y;
    sum[25] += p_z * m_x - p_x * m_z;
    sum[26] += p_x * m_y - p_y * m_x;
  }
  for (int i = 0; i < kTriangle + 6; ++i)
    equations[i] = (sum[i][0] + sum[i][1]) + (sum[i][2] + sum[i][3]);
}

#ifdef MVO_HAS_AVX2_KERNELS
MVO_AVX2 void addBlocksAvx2(const Constants& k, const double* data, int blocks, double* equations) {
  addBlocks(k, data, blocks, equations);
}
#endif

void addBlocksHere(const Constants& k, const double* data, int blocks, double* equations) {
#ifdef MVO_HAS_AVX2_KERNELS
  if (usesAvx2()) return addBlocksAvx2(k, data, blocks, equations);
#endif
  addBlocks(k, data, blocks, equations);
}

// A = L D L^T, in place; none if A is not positive definite.
std::optional<Vector6d> solve(Equations equations) {
  const auto at = [&equations](int row, int column) -> double& {
    return equations[row * (row + 1) / 2 + column];
  };
  double* b = equations.data() + kTriangle;
  for (int column = 0; column < 6; ++column) {
    at(column, column) += 1e-9;
    double scaled[6];
    for (int m = 0; m < column; ++m) scaled[m] = at(column, m) * at(m, m);
    for (int row = column; row < 6; ++row)
      for (int m = 0; m < column; ++m) at(row, column) -= at(row, m) * scaled[m];
    const double pivot = at(column, column);
    if (!(pivot > 0)) return std::nullopt;
    for (int row = column + 1; row < 6; ++row) at(row, column) /= pivot;
  }
  for (int row = 0; row < 6; ++row)
    for (int m = 0; m < row; ++m) b[row] -= at(row, m) * b[m];
  for (int row = 5; row >= 0; --row) {
    b[row] /= at(row, row);
    for (int m = row + 1; m < 6; ++m) b[row] -= at(m, row) * b[m];
  }
  return Vector6d(b);
}

}  // namespace

MotionFit::MotionFit(const LinkResidual& residual)
    : camera_(residual.camera()), ratio2_(residual.disparityVariance()) {}

void MotionFit::add(const StereoPair& pair) {
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

Eigen::Isometry3d MotionFit::refine(Eigen::Isometry3d T_b_a, double scale, int iterations) const {
  Constants k{camera_.fu, camera_.fv, camera_.fu * camera_.baseline,
              ratio2_,    {},         1 / (scale * scale)};
  for (int i = 0; i < iterations; ++i) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) k.T[4 * row + column] = T_b_a(row, column);
    Equations equations;
    addBlocksHere(k, data_.data(), (pairs_ + kDoubles - 1) / kDoubles, equations.data());
    const std::optional<Vector6d> step = solve(equations);
    if (!step || !step->allFinite() || step->norm() > 10) break;
    T_b_a = exp(*step) * T_b_a;
    if (step->norm() < 1e-9) break;
  }
  return T_b_a;
}

}  // namespace mvo
