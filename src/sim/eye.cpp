// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/eye.hpp"

#include <cmath>

namespace mvo::sim {
namespace {

constexpr double kDegree = M_PI / 180;

Eigen::Vector2d distorted(const Eigen::Vector2d& q, const Distortion& by) {
  const double square = q.squaredNorm();
  return q * (1 + by.radial * square) +
         by.tangential * Eigen::Vector2d(square + 2 * q.x() * q.x(), 2 * q.x() * q.y());
}

// Derivative of distorted() by the offset.
Eigen::Matrix2d stretch(const Eigen::Vector2d& q, const Distortion& by) {
  Eigen::Matrix2d tangential;
  tangential << 6 * q.x(), 2 * q.y(),  //
      2 * q.y(), 2 * q.x();
  return (1 + by.radial * q.squaredNorm()) * Eigen::Matrix2d::Identity() +
         2 * by.radial * q * q.transpose() + by.tangential * tangential;
}

}  // namespace

double Eye::rowTime(double row) const {
  const double middle = 0.5 * (lens.height - 1);
  return delay + readout * (row - middle) / (lens.height - 1);
}

Eigen::Vector2d Eye::project(const Eigen::Vector3d& p) const {
  const Eigen::Vector2d center(lens.cu, lens.cv);
  const Eigen::Vector2d offset(lens.fu * p.x() / p.z(), lens.fv * p.y() / p.z());
  return center + distorted(offset, distortion);
}

Eigen::Vector2d Eye::undistort(const Eigen::Vector2d& pixel) const {
  if (!distortion.bends()) return pixel;
  constexpr int kMost = 20;         // Newton's method needs four or five
  constexpr double kExact = 1e-20;  // squared step [px^2]
  const Eigen::Vector2d center(lens.cu, lens.cv);
  const Eigen::Vector2d seen = pixel - center;
  Eigen::Vector2d offset = seen;
  for (int i = 0; i < kMost; ++i) {
    const Eigen::Vector2d step =
        stretch(offset, distortion).inverse() * (seen - distorted(offset, distortion));
    offset += step;
    if (step.squaredNorm() < kExact) break;
  }
  return center + offset;
}

Eye leftEye(const Scene& scene) {
  Eye eye;
  eye.lens = scene.camera;
  eye.readout = scene.options.imperfections.readout;
  return eye;
}

Eye rightEye(const Scene& scene) {
  const Imperfections& wrong = scene.options.imperfections;
  Eye eye;
  eye.side = Side::kRight;
  Eigen::Isometry3d T_camera_eye = Eigen::Isometry3d::Identity();
  T_camera_eye.translation().x() = scene.camera.baseline;
  T_camera_eye.linear() =
      (Eigen::AngleAxisd(wrong.right_yaw * kDegree, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(wrong.right_pitch * kDegree, Eigen::Vector3d::UnitX()) *
       Eigen::AngleAxisd(wrong.right_roll * kDegree, Eigen::Vector3d::UnitZ()))
          .matrix();
  eye.T_eye_camera = T_camera_eye.inverse();
  eye.lens = scene.camera;
  eye.lens.fu *= 1 + wrong.right_focal;
  eye.lens.fv *= 1 + wrong.right_focal;
  eye.lens.cu += wrong.right_center_u;
  eye.lens.cv += wrong.right_center_v;
  const double half_diagonal = 0.5 * std::hypot(eye.lens.width, eye.lens.height);
  eye.distortion.radial = wrong.right_radial / std::pow(half_diagonal, 3);
  eye.distortion.tangential = wrong.right_tangential / (3 * std::pow(half_diagonal, 2));
  eye.delay = wrong.right_delay;
  eye.readout = wrong.readout;
  return eye;
}

}  // namespace mvo::sim
