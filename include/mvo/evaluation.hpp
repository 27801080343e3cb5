// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// IV: how good a run is, by the paper's measures and by those that are usual since.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mvo/trajectory_files.hpp"

namespace mvo {

/// G_k ~ A P_k B for true poses G_k and estimated poses P_k.
struct Alignment {
  Eigen::Isometry3d A = Eigen::Isometry3d::Identity();  ///< T_trueworld_estimatedworld
  Eigen::Isometry3d B = Eigen::Isometry3d::Identity();  ///< T_estimatedbody_truebody

  Eigen::Isometry3d operator()(const Eigen::Isometry3d& P) const { return A * P * B; }
};

/// The error of one frame.
struct PoseError {
  std::size_t frame = 0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d roll_pitch_yaw = Eigen::Vector3d::Zero();  ///< about x, y, z [rad]
  double angle = 0;                                          ///< total [rad]
  int id = 0;                                                ///< the motion that gave the pose
};

/// Maxima and means of errors.
struct ErrorSummary {
  int frames = 0;
  double max = 0;             ///< of the translation's norm [m]
  double rmse = 0;            ///< [m]; over all frames this is the ATE
  double max_percent = 0;     ///< of the path; 0 for a path without length
  double rmse_percent = 0;    ///< of the path
  std::size_t max_frame = 0;  ///< the frame of max
  Eigen::Vector3d signed_max = Eigen::Vector3d::Zero();      ///< largest by magnitude, per axis [m]
  Eigen::Vector3d signed_max_rpy = Eigen::Vector3d::Zero();  ///< likewise [rad]
  Eigen::Vector3d rmse_rpy = Eigen::Vector3d::Zero();        ///< [rad]
  double max_angle = 0;                                      ///< [rad]
  double rmse_angle = 0;                                     ///< [rad]
};

/// Root mean squares and maxima of step errors; all zero for none.
struct StepSummary {
  int steps = 0;
  double rmse = 0;                  ///< [m]
  double max = 0;                   ///< [m]
  double rmse_angle = 0;            ///< [rad]
  double max_angle = 0;             ///< [rad]
  std::size_t max_frame = 0;        ///< the later frame of the step with max
  std::size_t max_angle_frame = 0;  ///< likewise of max_angle
};

/// The error of the last common pose when both trajectories start at their first common pose.
struct EndDrift {
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;
  double path = 0;             ///< of the truth between them [m]
  double translation = 0;      ///< [m]
  double percent = 0;          ///< of the path; 0 for a path without length
  double angle = 0;            ///< [rad]
  double angle_per_metre = 0;  ///< [rad/m]; 0 for a path without length
};

/// Frames [first, last] in which a body is not gone.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The motions of one frame, the static world included.
struct MotionCount {
  int found = 0;          ///< ids >= 0 with at least one labelled tracklet
  int least = 1;          ///< the static world and the required bodies
  int most = 1;           ///< and those that may be found
  bool labelled = false;  ///< the frame has any label, outliers included
  bool exact_set =
      false;  ///< exactly one id per body that is found, all required ones, no other id

  bool right() const { return least <= found && found <= most; }
};

/// Share of frames [%]; none of no frames is 0.
struct RightNumberRates {
  int frames = 0;
  double all = 0;            ///< right number, all frames
  double after_first_3 = 0;  ///< right number, without the first 3 frames
  double labelled = 0;       ///< right number, of the frames that have labels
  double exact_set = 0;      ///< exact set, all frames
  double exact_set_after_first_3 = 0;
  double exact_set_labelled = 0;
};

/// Which body (0: the static world) each id belongs to.
using Association = std::map<int, int>;

/// Counts of one class: the static world (0) or a body.
struct ClassScore {
  int true_positives = 0;
  int false_positives = 0;
  int false_negatives = 0;  ///< outlier labels included
  int outliers = 0;         ///< of the false negatives: those labelled -1

  double precision() const;              ///< [%], 0 if nothing was found
  double recall() const;                 ///< [%], 0 if there was nothing to find
  double recallWithoutOutliers() const;  ///< [%], outlier labels left out
};

/// Frames in which a boxed body is clear, and those of them in which it has its own label.
struct BoxScore {
  int frames = 0;
  int labelled = 0;

  double percent() const;  ///< 0 of no frames
};

/// How the tracklets of a part of the image are labelled; what is neither of these has an id >= 1.
struct LabelShares {
  int tracklets = 0;
  int static_world = 0;
  int outliers = 0;

  // Of the tracklets [%], 0 if there are none.
  double staticPercent() const;
  double outlierPercent() const;
  double movingPercent() const;
};

/// Frames in which a boxed body's trajectory can be seen, and those in which it is in the box.
struct BoxPlacement {
  int frames = 0;
  int inside = 0;
};

/// The figures of a body that is known by its boxes. Clear: nothing hides it.
struct BoxedBody {
  std::string body;  ///< empty for the one of boxes.csv
  int frames = 0;    ///< with a box
  int clear_frames = 0;
  int found = 0;                           ///< frames in which an id holds it
  int found_clear = 0;                     ///< those of them in which it is clear
  int found_without_outliers = 0;          ///< likewise, outlier labels left out
  std::optional<std::size_t> first_found;  ///< by an id, be it clear or not
  std::vector<int> ids;                    ///< that hold it in some frame
  int id_switches = 0;
  int own_label = 0;                       ///< clear frames with a label that is hardly elsewhere
  LabelShares labels;                      ///< inside the box in clear frames
  std::vector<std::size_t> static_frames;  ///< clear ones; most in the box but outliers is 0
  std::optional<BoxPlacement> placement;   ///< with a calibration

  double foundPercent() const;
  double foundClearPercent() const;
};

/// What lies outside of all boxes, in the frames that have boxes.
struct BackgroundLabels {
  LabelShares labels;
  int frames = 0;                              ///< with labels there that are no outliers
  std::vector<std::size_t> not_static_frames;  ///< those in which most of these are not 0
};

/// The depth of a body as its velocity and the way of its box in the image tell.
struct ImpliedDepth {
  double z = 0;   ///< [m]
  double sd = 0;  ///< [m]
};

/// A mean velocity against the estimate's, in the axes of the camera at the first frame.
struct VelocityScore {
  TrueVelocity truth;
  std::size_t first = 0;
  std::size_t last = 0;
  int id = 0;  ///< the motion that holds the body; 0: none that has both poses, the rest is empty
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  double displacement_error = 0;                       ///< in the plane of x and z [m]
  double depth = 0;                                    ///< of the body's frame, halfway [m]
  std::optional<ImpliedDepth> implied_depth;

  double errorX() const { return velocity.x() - truth.vx; }  ///< [m/s]
  double errorZ() const { return velocity.z() - truth.vz; }  ///< [m/s]
};

/// What is known by boxes.
struct BoxEvaluation {
  BoxScore own_label;  ///< over all bodies
  std::vector<BoxedBody> bodies;
  BackgroundLabels background;
  std::vector<VelocityScore> velocities;
};

/// Times of one stage over all frames that have it.
struct StageTime {
  std::string stage;
  int frames = 0;
  double median = 0;  ///< [ms]
  double mean = 0;    ///< [ms]
  double p95 = 0;     ///< [ms]
  double max = 0;     ///< [ms]
};

enum class CameraAlignment { kLeft, kLeftRight };

struct EvaluationOptions {
  CameraAlignment camera_alignment = CameraAlignment::kLeft;
};

/// Normalised squared errors per degree of freedom: 1 if covariances are true.
struct Nees {
  int samples = 0;
  double mean = 0;
  double low = 0;  ///< between this and `high` lies the mean of so many true ones, 95 times of 100
  double high = 0;
  int beyond = 0;  ///< samples above the 99 % quantile
};

/// NEES in one frame.
struct FrameNees {
  std::size_t frame = 0;
  double nees = 0;
};

/// Whether a motion's covariances are true.
struct Consistency {
  Nees step;                   ///< of every newest step
  Nees window;                 ///< of the motions in windows that do not overlap
  std::vector<FrameNees> all;  ///< since the first frame
};

/// The camera's figures.
struct CameraEvaluation {
  Alignment alignment;
  double path = 0;              ///< of the whole true trajectory [m]
  int estimated = 0;            ///< frames with an estimated pose
  double coverage = 0;          ///< of all frames [%]
  ErrorSummary errors;          ///< errors.rmse is the ATE
  StepSummary steps;            ///< RPE over consecutive frames
  std::optional<double> scale;  ///< estimated over true path; none for a path without length
  std::optional<EndDrift> drift;
  std::vector<PoseError> curve;
  Consistency consistency;
};

/// Errors within one stretch in view.
struct StretchEvaluation {
  Stretch stretch;
  ErrorSummary errors;
  ErrorSummary visible_errors;  ///< the frames of it in which the body is visible
};

/// One body's figures.
struct BodyEvaluation {
  int body = 0;
  double path = 0;           ///< of the whole true trajectory [m]
  std::vector<int> ids;      ///< estimated motions on this body
  int estimated = 0;         ///< frames with an estimated pose
  int duplicate_frames = 0;  ///< with poses of several ids
  ErrorSummary errors;
  StepSummary steps;  ///< per-frame motion error
  std::vector<PoseError> curve;
  Consistency consistency;

  // With visibility.
  bool has_visibility = false;
  int required_frames = 0;      ///< visible and moving
  int visible_frames = 0;       ///< moving or not
  double coverage = 0;          ///< of the required frames [%]
  double coverage_visible = 0;  ///< of the visible frames [%]
  ErrorSummary visible_errors;
  StepSummary visible_steps;
  std::vector<StretchEvaluation> stretches;

  // With masks.
  bool has_masks = false;
  int id_switches = 0;
  double one_label = 0;  ///< share of one and the same id among its observations [%]
  ClassScore segmentation;
};

/// The figures of a run.
struct Evaluation {
  int frames = 0;
  std::optional<CameraEvaluation> camera;
  std::vector<BodyEvaluation> bodies;
  std::vector<MotionCount> counts;  ///< per frame; empty if the truth does not know the bodies
  RightNumberRates rates;
  std::optional<ClassScore> static_world;
  Association association;                ///< body (0: static world) by id
  std::optional<int> third_party_frames;  ///< with at least one tracklet of an id >= 1
  std::optional<BoxEvaluation> boxes;
  std::vector<StageTime> times;
  std::vector<std::string> notes;  ///< what the reader should know before believing the figures
};

/// Law: an estimate that is the truth up to one transform of the world, and one of each body's
/// frame, has zero errors. Throws std::runtime_error if estimate and truth share no frame.
Evaluation evaluate(const Estimate& estimate, const Truth& truth,
                    const EvaluationOptions& options = {});

/// The truth of the frames between the first and the last that the estimate has seen.
Truth cropToEstimate(const Truth& truth, const Estimate& estimate);

}  // namespace mvo
