// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/error_field.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mvo {

namespace {
constexpr int kGrid = 8;  // places per side of the image where shifts are expected...
constexpr double kTypicalShift = 2.5e-3;  // ... to be of this size [focal lengths]
}  // namespace

Eigen::Matrix<double, 2, kErrorTerms> errorFields(const StereoCamera& camera,
                                                  const Eigen::Vector3d& y_lr,
                                                  const Eigen::Vector2d& velocity) {
  const double x = (y_lr.z() - camera.cu) / camera.fu;
  const double y = (y_lr.y() - camera.cv) / camera.fv;
  const double d = (y_lr.x() - y_lr.z()) / camera.fu;
  const double r2 = x * x + y * y;
  Eigen::Matrix<double, 2, kErrorTerms> fields = Eigen::Matrix<double, 2, kErrorTerms>::Zero();
  fields.col(kAcross) << 1, 0;
  fields.col(kDown) << 0, 1;
  fields.col(kRoll) << -y, x;
  fields.col(kScale) << x, y;
  fields.col(kRadial) << x * r2, y * r2;
  fields.col(kTurn) << 1 + x * x, x * y;
  fields.col(kTilt) << x * y, 1 + y * y;
  fields.col(kTangentialU) << r2 + 2 * x * x, 2 * x * y;
  fields.col(kTangentialV) << 2 * x * y, r2 + 2 * y * y;
  fields.col(kWidth) << x, 0;
  fields.col(kShear) << y, 0;
  fields.col(kRise) << 0, d;
  fields.row(0) *= camera.fu;
  fields.row(1) *= camera.fv;
  fields.col(kDelay) = velocity;
  return fields;
}

double shiftAcross(const StereoCamera& camera, const Eigen::Vector3d& y_lr, double velocity,
                   const ErrorVector& n) {
  const double x = (y_lr.z() - camera.cu) / camera.fu;
  const double y = (y_lr.y() - camera.cv) / camera.fv;
  const double r2 = x * x + y * y;
  return camera.fu * (n[kAcross] - n[kRoll] * y + x * (n[kScale] + n[kWidth] + n[kRadial] * r2) +
                      n[kTurn] * (1 + x * x) + x * y * (n[kTilt] + 2 * n[kTangentialV]) +
                      n[kTangentialU] * (r2 + 2 * x * x) + n[kShear] * y) +
         n[kDelay] * velocity;
}

ErrorEstimate::Rows ErrorEstimate::rows(const StereoCamera& camera,
                                        const Eigen::Vector3d& y) const {
  const ErrorVector field = errorFields(camera, y, Eigen::Vector2d::Zero()).row(1).transpose();
  return {field.dot(mean), std::sqrt(std::max(0.0, field.dot(covariance * field)))};
}

ErrorEstimate expectedErrors(const StereoCamera& camera) {
  ErrorVector deviation;
  deviation[kAcross] = 1e-2;
  deviation[kDown] = 1e-2;
  deviation[kRoll] = 3e-3;
  deviation[kScale] = 5e-3;
  deviation[kRadial] = 5e-3;
  deviation[kTurn] = 1e-2;
  deviation[kTilt] = 1e-2;
  deviation[kTangentialU] = 5e-3;
  deviation[kTangentialV] = 5e-3;
  deviation[kWidth] = 1e-3;
  deviation[kShear] = 1e-3;
  deviation[kRise] = 3e-3;
  deviation[kDelay] = 5e-3;
  ErrorMatrix information = deviation.cwiseAbs2().cwiseInverse().asDiagonal();
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const double u = (i + 0.5) / kGrid * camera.width;
      const double v = (j + 0.5) / kGrid * camera.height;
      auto fields = errorFields(camera, {u, v, u}, Eigen::Vector2d::Zero());
      fields.row(0) /= camera.fu;
      fields.row(1) /= camera.fv;
      information += fields.transpose() * fields / (kGrid * kGrid * kTypicalShift * kTypicalShift);
    }
  return {ErrorVector::Zero(), information.inverse()};
}

}  // namespace mvo
