// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What has been said of the camera, and what physics lets it do next.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mvo/options.hpp"
#include "mvo/types.hpp"
#include "trajectories/prediction_errors.hpp"

namespace mvo {

/// A camera's motion from one frame to the next, as measured.
struct CameraStep {
  Eigen::Isometry3d T_ckm1_ck = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of its perturbation [m^2, m rad, rad^2]
};

/// Remembers the newest pose that was said, valid or not, and the newest steps. A camera keeps its
/// twist but for a plausible acceleration; lost, it is taken to do so for a while and then to
/// stand.
class CameraTrack {
 public:
  bool everFound() const { return ever_found_; }  ///< whether there has been an estimate
  const Eigen::Isometry3d& newest() const { return T_world_ck_; }  ///< as it was said
  bool lost() const { return last_found_ns_ != stamp_ns_; }        ///< whether that was no estimate

  /// Where the camera is at a later time if it keeps its last twist, for options.extrapolation
  /// seconds after its last estimate at most.
  Eigen::Isometry3d predict(std::int64_t stamp_ns, const TrajectoryOptions& options) const;

  /// Why a step to this time cannot be; empty if it can. It departs from the twist of the last
  /// estimate, or of the step measured before it, by no more than options' accelerations and three
  /// standard deviations of both allow.
  std::string objection(const CameraStep& step, std::int64_t stamp_ns,
                        const TrajectoryOptions& options) const;

  /// Whether a pose at this time goes on from the newest that was said, of which `step` says where
  /// it is: they differ by no more than acceleration and the covariance of the pose account for.
  bool continues(const Eigen::Isometry3d& T_world_ck, const CameraStep& step, std::int64_t stamp_ns,
                 const Matrix6d& pose_covariance, const TrajectoryOptions& options) const;

  /// T_newest_found: the camera that was last estimated, in that of newest().
  Eigen::Isometry3d fromLastFound() const { return T_world_ck_.inverse() * T_world_found_; }

  /// Of the right perturbation of newest(), what going on by rule since the last estimate adds to
  /// it [m^2, m rad, rad^2]; zero if that was an estimate.
  Matrix6d predictionCovariance(const TrajectoryOptions& options) const;

  /// A step that was measured, believed or not.
  void measured(const CameraStep& step, std::int64_t stamp_ns);
  /// The pose that is said: an estimate, or where it is taken to be while it is lost.
  void say(const Eigen::Isometry3d& T_world_ck, std::int64_t stamp_ns, bool valid);

 private:
  struct Motion {
    Vector6d twist = Vector6d::Zero();  // in the camera's axes [m/s, rad/s]
    double sd_translation = 0;          // [m/s]
    double sd_rotation = 0;             // [rad/s]
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
  };
  std::string departure(const Motion& now, const Motion& before,
                        const TrajectoryOptions& options) const;
  Motion motionOf(const CameraStep& step, std::int64_t stamp_ns) const;

  Eigen::Isometry3d T_world_ck_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_found_ = Eigen::Isometry3d::Identity();  // the last estimate
  std::int64_t stamp_ns_ = 0;                                        // of the newest pose
  std::int64_t last_found_ns_ = 0;                                   // of the last estimate
  bool ever_found_ = false;
  PredictionErrors errors_;
  std::optional<Motion> measured_;
  std::optional<Motion> believed_;
};

}  // namespace mvo
