// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/camera_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr double kDeviations = 3;  // that noise accounts for

constexpr double kDegrees = 180 / M_PI;

template <typename... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 240> out{};
  std::snprintf(out.data(), out.size(), format, values...);
  return out.data();
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

// Of a vector from the nearest point between another one and `ratio` times that.
double distance(const Eigen::Vector3d& v, const Eigen::Vector3d& other, double ratio) {
  const double length2 = other.squaredNorm();
  const double scale = length2 > 0 ? v.dot(other) / length2 : 1;
  return (v - std::clamp(scale, std::min(1.0, ratio), std::max(1.0, ratio)) * other).norm();
}

double translationDeviation(const Matrix6d& covariance) {
  return std::sqrt(std::max(0.0, covariance.topLeftCorner<3, 3>().trace()));
}
double rotationDeviation(const Matrix6d& covariance) {
  return std::sqrt(std::max(0.0, covariance.bottomRightCorner<3, 3>().trace()));
}

}  // namespace

CameraTrack::Motion CameraTrack::motionOf(const CameraStep& step, std::int64_t stamp_ns) const {
  const double rate = 1 / seconds(stamp_ns - stamp_ns_);
  return {rate * log(step.T_ckm1_ck), rate * translationDeviation(step.covariance),
          rate * rotationDeviation(step.covariance), stamp_ns_, stamp_ns};
}

Eigen::Isometry3d CameraTrack::predict(std::int64_t stamp_ns,
                                       const TrajectoryOptions& options) const {
  if (!believed_) return T_world_ck_;
  const std::int64_t until =
      believed_->to_ns + static_cast<std::int64_t>(1e9 * options.extrapolation);
  const double time = seconds(std::min(stamp_ns, until) - stamp_ns_);
  return time > 0 ? T_world_ck_ * exp(time * believed_->twist) : T_world_ck_;
}

Matrix6d CameraTrack::predictionCovariance(const TrajectoryOptions& options) const {
  if (!lost()) return Matrix6d::Zero();
  return errors_.covariance(seconds(stamp_ns_ - last_found_ns_), options);
}

// A motion is the mean over its step: what lies between two of them is the time from middle to
// middle. Stamps may jitter: the step that is expected is as long as they say, or as the last one,
// or anything between.
std::string CameraTrack::departure(const Motion& now, const Motion& before,
                                   const TrajectoryOptions& options) const {
  const double between =
      0.5 * (seconds(now.from_ns - before.from_ns) + seconds(now.to_ns - before.to_ns));
  const double step = seconds(now.to_ns - now.from_ns);
  const double ratio = seconds(before.to_ns - before.from_ns) / step;
  const double departs = distance(now.twist.head<3>(), before.twist.head<3>(), ratio);
  const double turns = distance(now.twist.tail<3>(), before.twist.tail<3>(), ratio);
  const double may_depart = options.max_acceleration * between +
                            kDeviations * (now.sd_translation + before.sd_translation);
  const double may_turn = options.max_angular_acceleration * between +
                          kDeviations * (now.sd_rotation + before.sd_rotation);
  if (departs <= may_depart && turns <= may_turn) return "";
  return text(
      "the camera cannot have moved so: %.3f m and %.2f deg from where its last motion leads in "
      "%.3f s, where %.3f m and %.2f deg are possible",
      step * departs, kDegrees * step * turns, step, step * may_depart, kDegrees * step * may_turn);
}

std::string CameraTrack::objection(const CameraStep& step, std::int64_t stamp_ns,
                                   const TrajectoryOptions& options) const {
  if (!believed_ || options.max_acceleration == 0) return "";
  const Motion now = motionOf(step, stamp_ns);
  std::string from_believed = departure(now, *believed_, options);
  if (from_believed.empty() || departure(now, *measured_, options).empty()) return "";
  return from_believed;
}

bool CameraTrack::continues(const Eigen::Isometry3d& T_world_ck, const CameraStep& step,
                            std::int64_t stamp_ns, const Matrix6d& pose_covariance,
                            const TrajectoryOptions& options) const {
  if (options.max_acceleration == 0 || !ever_found_) return true;
  const Vector6d change = log((T_world_ck_ * step.T_ckm1_ck).inverse() * T_world_ck);
  const double time = seconds(stamp_ns - last_found_ns_);
  return change.head<3>().norm() <= options.max_acceleration * time * time +
                                        kDeviations * translationDeviation(pose_covariance) &&
         change.tail<3>().norm() <= options.max_angular_acceleration * time * time +
                                        kDeviations * rotationDeviation(pose_covariance);
}

void CameraTrack::measured(const CameraStep& step, std::int64_t stamp_ns) {
  measured_ = motionOf(step, stamp_ns);
}

void CameraTrack::say(const Eigen::Isometry3d& T_world_ck, std::int64_t stamp_ns, bool valid) {
  if (valid && measured_ && measured_->to_ns == stamp_ns) {
    believed_ = measured_;
    errors_.add(stamp_ns, T_world_ck, believed_->twist);
  }
  if (valid) {
    last_found_ns_ = stamp_ns;
    T_world_found_ = T_world_ck;
    ever_found_ = true;
  }
  T_world_ck_ = T_world_ck;
  stamp_ns_ = stamp_ns;
}

}  // namespace mvo
