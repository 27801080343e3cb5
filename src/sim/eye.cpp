// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/eye.hpp"

#include <cmath>

namespace mvo::sim {
namespace {

constexpr double kDegree = M_PI / 180;

}  // namespace

double Eye::rowTime(double row) const {
  const double middle = 0.5 * (lens.height - 1);
  return delay + readout * (row - middle) / (lens.height - 1);
}

Eigen::Vector2d Eye::project(const Eigen::Vector3d& p) const {
  const Eigen::Vector2d center(lens.cu, lens.cv);
  const Eigen::Vector2d offset(lens.fu * p.x() / p.z(), lens.fv * p.y() / p.z());
  return center + offset * (1 + radial * offset.squaredNorm());
}

Eigen::Vector2d Eye::undistort(const Eigen::Vector2d& pixel) const {
  if (radial == 0) return pixel;
  constexpr int kIterations = 8;  // from the pixel itself Newton's method converges in four
  const Eigen::Vector2d center(lens.cu, lens.cv);
  const double seen = (pixel - center).norm();
  if (seen == 0) return pixel;
  double radius = seen;
  for (int i = 0; i < kIterations; ++i) {
    const double square = radial * radius * radius;
    radius -= (radius * (1 + square) - seen) / (1 + 3 * square);
  }
  return center + (pixel - center) * (radius / seen);
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
  eye.radial = wrong.right_radial / std::pow(half_diagonal, 3);
  eye.delay = wrong.right_delay;
  eye.readout = wrong.readout;
  return eye;
}

}  // namespace mvo::sim
