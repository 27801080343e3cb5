// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The door of the library: images in, the camera's and every other rigid body's SE(3) trajectory
// out.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mvo/deadline.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// One synchronized set of rectified images. Stereo: left and right; RGB-D: left (the colour image)
/// and depth.
struct Frame {
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< 8UC1
  cv::Mat right;  ///< 8UC1, empty for RGB-D
  cv::Mat depth;  ///< 32FC1 [m], registered to left, NaN or <= 0 = hole; empty for stereo
};

struct FrameImages;

/// A frame and what of its work depends on its images alone, see MultimotionOdometry::prepare().
struct PreparedFrame {
  std::int64_t stamp_ns = 0;
  std::shared_ptr<FrameImages> images;  ///< none if there is a problem
  std::string problem;                  ///< what is wrong with the images, or empty
  double prepare_ms = 0;                ///< that it took
};

/// kNew in the first frame of an id; the last two of those that have departed.
enum class MotionState { kNew, kTracked, kStopped, kLost };

/// One motion as known at a frame. The static world (id 0) is the camera's own motion.
struct MotionEstimate {
  LabelId id = kStatic;
  MotionState state = MotionState::kTracked;
  Eigen::Isometry3d T_world_motion =
      Eigen::Isometry3d::Identity();  ///< id 0: T_world_camera (III-G, geocentric)
  Eigen::Isometry3d T_ck_c1 =
      Eigen::Isometry3d::Identity();  ///< ^lT_CkC1; its inverse is the egocentric motion
  Matrix6d covariance =
      Matrix6d::Zero();  ///< of the left perturbation of T_ck_c1 (rho, phi) [m^2, m rad, rad^2]
  Eigen::Isometry3d T_ck_motion =
      Eigen::Isometry3d::Identity();  ///< egocentric pose of the motion's frame; id 0: of the world
  std::optional<Eigen::Isometry3d>
      T_ckm1_motion;  ///< the same, in the frame before; none if there was no pose then
  Matrix6d step_covariance =
      Matrix6d::Zero();     ///< of the left perturbation of T_ck_ckm1 [m^2, m rad, rad^2]
  double significance = 0;  ///< of the motion in the window against rest, see restDistance()
  FrameId first_frame = 0;  ///< C_1
  FrameId birth_frame = 0;  ///< of the id
  int support = 0;          ///< tracklets in the window
  int visible = 0;          ///< tracklets seen in this frame
  double rms = 0;           ///< of the batch's residuals [px]
  bool converged = false;   ///< the batch
  Eigen::Vector3d centroid_world =
      Eigen::Vector3d::Zero();  ///< of the points seen in this frame [m]
  /// The box around the points seen in this frame but the outermost twentieth on each side, which
  /// may be mislabelled; along the axes of the motion's frame [m], empty if there are none.
  Eigen::AlignedBox3d extent_motion;
};

/// An id without a pose in this frame.
struct DepartedMotion {
  LabelId id = kOutlier;
  MotionState state = MotionState::kLost;  ///< kStopped: its points are part of the static world
  Eigen::Isometry3d T_world_motion = Eigen::Isometry3d::Identity();  ///< its last
  FrameId birth_frame = 0;
  FrameId last_frame = 0;  ///< with a pose
};

/// A tracklet seen in a frame and what it was found to belong to.
struct LabeledPoint {
  TrackletId tracklet = 0;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< (u_l, v, u_r) [px]
  LabelId id = kOutlier;
  int length = 1;  ///< observations so far
};

/// A pose that later frames have improved: the estimate of a past frame as of the last window that
/// contains it.
struct SmoothedPose {
  LabelId id = kStatic;
  FrameId frame = 0;
  Eigen::Isometry3d T_world_motion = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_ck_motion = Eigen::Isometry3d::Identity();  ///< id 0: T_ck_world
};

/// What addFrame knows after one frame.
struct MultimotionEstimate {
  FrameId frame = 0;
  FrameId window_begin = 0;  ///< the oldest frame of the window
  std::int64_t stamp_ns = 0;
  bool valid = false;   ///< false: no estimate of the camera, `problem` says why
  std::string problem;  ///< one sentence, empty if all is well
  std::vector<MotionEstimate>
      motions;  ///< those with a pose in this frame; the camera (id 0) first
  std::vector<LabeledPoint>
      points;  ///< every tracklet with at least two observations that is seen in this frame
  std::vector<DepartedMotion> departed;  ///< resting ids, and once those just lost
  std::vector<SmoothedPose> smoothed;    ///< all poses of this window
  int rounds = 0;                        ///< of the label loop
  bool converged = false;                ///< the labels settled and nothing was cut short
  CutShort cut_short;                    ///< by engine.time_budget_ms
  int unestimated = 0;                   ///< labels that had support but no pose in this frame
  std::vector<std::pair<std::string, double>>
      timings_ms;  ///< stage and wall time, in the order of the pipeline
};

/// Owns the only memory between frames. Bad frames (empty, of another size, stamps that go back, no
/// texture) never throw: the estimate says what is wrong. Throws std::invalid_argument from the
/// constructor for invalid options or calibration.
class MultimotionOdometry {
 public:
  MultimotionOdometry(const StereoCamera& camera, const Options& options);
  ~MultimotionOdometry();
  MultimotionOdometry(MultimotionOdometry&&) noexcept;
  MultimotionOdometry& operator=(MultimotionOdometry&&) noexcept;

  /// engine.time_budget_ms counts from when the images are prepared. In any case points are
  /// followed and labelled and every motion has a pose; the rest ends when the time is up.
  MultimotionEstimate addFrame(const Frame& frame);
  /// The two halves of addFrame: a next frame may be prepared by another thread while this one is
  /// added. A prepared frame is added once.
  PreparedFrame prepare(const Frame& frame) const;
  MultimotionEstimate addPrepared(PreparedFrame&& frame);
  /// Takes effect with the next frame. Throws std::invalid_argument naming the option if one is
  /// invalid or, like the window's length, cannot change while frames are remembered.
  void setOptions(const Options& options);
  /// Forgets all but the options; the next frame is frame 0 of a new world.
  void reset();

 private:
  struct State;
  StereoCamera camera_;  // neither changes, so prepare() needs no lock
  FrontendOptions preparation_;
  std::unique_ptr<State> state_;
};

}  // namespace mvo
