// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/link_residual.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/link.hpp"
#include "mvo/se3.hpp"

namespace mvo {

namespace {

struct Entries {
  double T[12];  // row by row

  explicit Entries(const Eigen::Isometry3d& of) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) T[4 * row + column] = of(row, column);
  }
};

}  // namespace

LinkResidual::LinkResidual(const StereoCamera& camera, const NoiseOptions& noise,
                           ResidualModel model)
    : camera_(camera), model_(model), ratio2_(std::pow(noise.disparity / noise.left, 2)) {}

double LinkResidual::operator()(const Eigen::Isometry3d& T_b_a, const Eigen::Vector3d& y_a,
                                const Eigen::Vector3d& y_b) const {
  const LinkConstants<OneLink> k(camera_, ratio2_);
  const Entries entries(T_b_a);
  const LinkPoint<OneLink> a(camera_, y_a);
  const LinkPoint<OneLink> b(camera_, y_b);
  const double from[3] = {a.x, a.y, a.d};
  const double seen[3] = {b.x, b.y, b.d};
  double e2 = 0;
  if (model_ == ResidualModel::kWhitened)
    squaredResidual<TwoRoundings, OneLink, ResidualModel::kWhitened>(k, entries.T, from, seen, e2);
  else
    squaredResidual<TwoRoundings, OneLink, ResidualModel::kImageDistance>(k, entries.T, from, seen,
                                                                          e2);
  return std::sqrt(e2);
}

bool LinkResidual::linearize(const Eigen::Isometry3d& T_b_a, const Eigen::Vector3d& y_a,
                             const Eigen::Vector3d& y_b, Link* link) const {
  const double disparity = std::max(y_a.x() - y_a.z(), kLeastDisparity);
  const double z_a = camera_.fu * camera_.baseline / disparity;
  const Eigen::Vector3d p_a((y_a.x() - camera_.cu) * z_a / camera_.fu,
                            (y_a.y() - camera_.cv) * z_a / camera_.fv, z_a);
  const Eigen::Vector3d rotated = T_b_a.linear() * p_a;
  const Eigen::Vector3d p_b = rotated + T_b_a.translation();
  if (p_b.z() < kLinkNearest) return false;
  const double w = 1.0 / p_b.z();
  const double x = p_b.x() * w;
  const double y = p_b.y() * w;
  const double fb = camera_.fu * camera_.baseline;
  link->residual << y_b.x() - (camera_.fu * x + camera_.cu),
      y_b.y() - (camera_.fv * y + camera_.cv), (y_b.x() - y_b.z()) - fb * w;
  Eigen::Matrix3d S;
  S << camera_.fu * w, 0, -camera_.fu * x * w, 0, camera_.fv * w, -camera_.fv * y * w, 0, 0,
      -fb * w * w;
  link->jacobian = S * odot(p_b.homogeneous());
  const Eigen::Vector3d j = -S * rotated / disparity;
  const double scale = z_a * w;
  const Eigen::Vector3d d_inverse(1.0 / (1.0 + scale * scale), 1.0 / (1.0 + scale * scale),
                                  1.0 / ratio2_);
  const Eigen::Vector3d dj = d_inverse.cwiseProduct(j);
  link->information = d_inverse.asDiagonal();
  link->information -= dj * dj.transpose() / (1.0 / ratio2_ + j.dot(dj));
  link->information *= 2.0;
  return true;
}

}  // namespace mvo
