// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/link_residual.hpp"

#include <algorithm>
#include <cmath>

#include "mvo/se3.hpp"

namespace mvo {

LinkResidual::LinkResidual(const StereoCamera& camera, const NoiseOptions& noise,
                           ResidualModel model)
    : camera_(camera), model_(model), ratio2_(std::pow(noise.disparity / noise.left, 2)) {}

double LinkResidual::operator()(const Eigen::Isometry3d& T_b_a, const Eigen::Vector3d& y_a,
                                const Eigen::Vector3d& y_b) const {
  const double disparity = std::max(y_a.x() - y_a.z(), kMinDisparity);
  const double z_a = camera_.fu * camera_.baseline / disparity;
  const Eigen::Vector3d p_a((y_a.x() - camera_.cu) * z_a / camera_.fu,
                            (y_a.y() - camera_.cv) * z_a / camera_.fv, z_a);
  const Eigen::Vector3d rotated = T_b_a.linear() * p_a;
  const Eigen::Vector3d p_b = rotated + T_b_a.translation();
  if (p_b.z() < kNearest) return kBehind;
  const double w = 1.0 / p_b.z();
  const double x = p_b.x() * w;
  const double y = p_b.y() * w;
  const double e_u = y_b.x() - (camera_.fu * x + camera_.cu);
  const double e_v = y_b.y() - (camera_.fv * y + camera_.cv);
  if (model_ == ResidualModel::kImageDistance) return std::sqrt(e_u * e_u + e_v * e_v);

  const double fb = camera_.fu * camera_.baseline;
  const double e_d = (y_b.x() - y_b.z()) - fb * w;
  // The covariance is D + ratio^2 j j^T: noise of both images, and the first disparity's, which
  // acts along the ray (dp/dd = -p/d).
  const double scale = z_a * w;
  const double g = -w / disparity;
  const double j_u = camera_.fu * g * (rotated.x() - x * rotated.z());
  const double j_v = camera_.fv * g * (rotated.y() - y * rotated.z());
  const double j_d = -fb * w * g * rotated.z();
  const double d_uv = 1.0 / (1.0 + scale * scale);
  const double d_d = 1.0 / ratio2_;
  const double squares = d_uv * (e_u * e_u + e_v * e_v) + d_d * e_d * e_d;
  const double mixed = d_uv * (e_u * j_u + e_v * j_v) + d_d * e_d * j_d;
  const double norm = 1.0 / ratio2_ + d_uv * (j_u * j_u + j_v * j_v) + d_d * j_d * j_d;
  return std::sqrt(std::max(0.0, 2.0 * (squares - mixed * mixed / norm)));
}

bool LinkResidual::linearize(const Eigen::Isometry3d& T_b_a, const Eigen::Vector3d& y_a,
                             const Eigen::Vector3d& y_b, Link* link) const {
  const double disparity = std::max(y_a.x() - y_a.z(), kMinDisparity);
  const double z_a = camera_.fu * camera_.baseline / disparity;
  const Eigen::Vector3d p_a((y_a.x() - camera_.cu) * z_a / camera_.fu,
                            (y_a.y() - camera_.cv) * z_a / camera_.fv, z_a);
  const Eigen::Vector3d rotated = T_b_a.linear() * p_a;
  const Eigen::Vector3d p_b = rotated + T_b_a.translation();
  if (p_b.z() < kNearest) return false;
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
