// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/prediction_errors.hpp"

#include <algorithm>
#include <cmath>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr std::size_t kRemembered = 100;  // poses

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

// What an acceleration of `limit`, three standard deviations of it, can do in so many seconds.
double varianceOf(double limit, double time) { return std::pow(0.5 * limit / 3 * time * time, 2); }

}  // namespace

Eigen::Isometry3d predictedMotion(const Vector6d& twist, double seconds,
                                  const TrajectoryOptions& options) {
  return exp(std::clamp(seconds, 0.0, options.extrapolation) * twist);
}

void PredictionErrors::add(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_ck,
                           const Vector6d& twist) {
  past_.push_back({stamp_ns, T_world_ck, twist});
  if (past_.size() > kRemembered) past_.pop_front();
}

Matrix6d PredictionErrors::covariance(double time, const TrajectoryOptions& options) const {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(varianceOf(options.max_acceleration, time)),
      Eigen::Vector3d::Constant(varianceOf(options.max_angular_acceleration, time));
  Matrix6d possible = variances.asDiagonal();

  Matrix6d sum = Matrix6d::Zero();
  int count = 0;
  std::size_t b = 0;
  for (std::size_t a = 0; a < past_.size(); ++a) {
    while (b < past_.size() && seconds(past_[b].stamp_ns - past_[a].stamp_ns) < time) ++b;
    if (b == past_.size()) break;
    const double later = seconds(past_[b].stamp_ns - past_[a].stamp_ns);
    const Eigen::Isometry3d T_ca_cb = past_[a].T_world_ck.inverse() * past_[b].T_world_ck;
    const Vector6d e = log(predictedMotion(past_[a].twist, later, options).inverse() * T_ca_cb);
    sum += e * e.transpose();
    ++count;
  }
  if (count == 0) return possible;
  // What is possible counts as one stretch of time among those that were seen.
  const double stretches = seconds(past_.back().stamp_ns - past_.front().stamp_ns) / time;
  return (stretches * sum / count + possible) / (stretches + 1);
}

}  // namespace mvo
