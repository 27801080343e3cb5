// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/odometry.hpp"

#include <utility>

#include "engine/ransac.hpp"
#include "engine/segmenter.hpp"
#include "frontend/camera/camera_model.hpp"
#include "frontend/camera/error_report.hpp"
#include "frontend/camera/learnt_errors.hpp"
#include "frontend/feature_tracker.hpp"
#include "frontend/prediction.hpp"
#include "frontend/tracklet_window.hpp"
#include "kernels/link_residual.hpp"
#include "stopwatch.hpp"
#include "trajectories/motion_trajectories.hpp"

namespace mvo {

namespace {

constexpr double kUncalibrated = 3;  // thresholds of a pair whose errors are not known yet

std::string complaintOf(const PreparedFrame& frame, std::int64_t last_stamp_ns) {
  if (!frame.problem.empty() || frame.stamp_ns > last_stamp_ns) return frame.problem;
  return "the stamp goes back or stands still: " + std::to_string(frame.stamp_ns) + " ns after " +
         std::to_string(last_stamp_ns) + " ns";
}

// What the labels of the last window say about the frame `next`.
KnownMotions knownMotions(const Segmenter& segmenter, FrameId next) {
  KnownMotions motions;
  motions.step_of = segmenter.labelOf();
  for (const KnownLabel& label : segmenter.labels())
    motions.steps.push_back({label.trajectory.between(next - 1, next - 2), label.id > kStatic});
  return motions;
}

MultimotionEstimate refused(FrameId frame, std::int64_t stamp_ns, const std::string& problem,
                            const Eigen::Isometry3d& T_world_camera) {
  MultimotionEstimate estimate;
  estimate.T_world_camera = T_world_camera;
  estimate.frame = frame;
  estimate.stamp_ns = stamp_ns;
  estimate.problem = problem;
  return estimate;
}

// How the step went.
void report(const Segmentation& segmentation, MultimotionEstimate& estimate) {
  estimate.rounds = segmentation.rounds;
  estimate.converged = segmentation.converged;
  estimate.cut_short = segmentation.cut_short;
}

// The engine's stages stand where the engine stood among the step's; "total" is their sum.
std::vector<std::pair<std::string, double>> timings(
    double prepare_ms, const std::vector<std::pair<std::string, double>>& laps,
    const std::vector<std::pair<std::string, double>>& engine_laps) {
  std::vector<std::pair<std::string, double>> all{{"prepare", prepare_ms}};
  double total = prepare_ms;
  for (const auto& lap : laps) {
    if (lap.first == "engine")
      all.insert(all.end(), engine_laps.begin(), engine_laps.end());
    else
      all.push_back(lap);
    total += lap.second;
  }
  all.emplace_back("total", total);
  return all;
}

}  // namespace

// Each member is the memory of one stage.
struct MultimotionOdometry::Memory {
  Memory(const StereoCamera& camera, const WindowOptions& options)
      : tracker(options.max_gap), window(options), model(camera) {}

  void follow(PreparedFrame& frame, const StereoCamera& camera, const Options& options);
  void cutBrokenLinks(const StereoCamera& camera, const Options& options);
  void learnCamera(const Segmentation& segmentation, const StereoCamera& camera,
                   const Options& options);
  void learnFirstMotion(const StereoCamera& camera, const Options& options);
  std::vector<SeenTracklet> seen() const;

  std::vector<Feature> features;  // of the last frame
  FeatureTracker tracker;
  TrackletWindow window;
  CameraModel model;
  Segmenter segmenter;
  MotionTrajectories trajectories;
  FrameId next_frame = 0;
  std::int64_t last_stamp_ns = -1;
};

// Points are followed to where they are expected, and the window slides on.
void MultimotionOdometry::Memory::follow(PreparedFrame& frame, const StereoCamera& camera,
                                         const Options& options) {
  model.addFrame(next_frame, 1e-9 * static_cast<double>(frame.stamp_ns),
                 !frame.images->depth.empty(), options);
  TrackingPrior prior = predictFeatures(features, window, knownMotions(segmenter, next_frame),
                                        camera, options.frontend.min_disparity);
  prior.errors = model.errors(options);
  features = tracker.track(std::move(*frame.images), prior, camera, options.frontend);
  window.add(next_frame++, features);
  last_stamp_ns = frame.stamp_ns;
  model.learnRows(features, window, options);
  model.correct(window.window(), camera, options);
  if (segmenter.labels().empty()) learnFirstMotion(camera, options);
}

// Before anything is labelled, what most points do is the best guess of how the world moves.
void MultimotionOdometry::Memory::learnFirstMotion(const StereoCamera& camera,
                                                   const Options& options) {
  if (!model.errors(options) || window.window().frames() < 2) return;
  const Window& seen = model.measured();
  const FrameId b = seen.last_frame;
  std::vector<StereoPair> pairs;
  std::vector<int> tracklets;
  for (std::size_t p = 0; p < seen.tracklets.size(); ++p) {
    const Observation* at_a = seen.tracklets[p].find(b - 1);
    const Observation* at_b = seen.tracklets[p].find(b);
    if (at_a == nullptr || at_b == nullptr) continue;
    pairs.push_back({at_a->y, at_b->y});
    tracklets.push_back(static_cast<int>(p));
  }
  ProposalOptions wide = options.proposal;
  wide.threshold *= kUncalibrated;
  const LinkResidual residual(camera, options.noise, ResidualModel::kWhitened);
  const auto motion = ransacMotion(pairs, residual, wide, options.seed);
  if (!motion) return;
  Trajectory step;
  step.first_frame = b - 1;
  step.T_ck_c1 = {Eigen::Isometry3d::Identity(), motion->T_b_a};
  step.segment = {0, 0};
  std::vector<int> world;
  for (std::size_t i = 0; i < tracklets.size(); ++i)
    if (motion->inlier[i] != 0) world.push_back(tracklets[i]);
  model.learnMotion(step, world, camera, options);
  model.correct(window.window(), camera, options);
}

// The newest frame's tracklets, where an exact camera would have seen them.
std::vector<SeenTracklet> MultimotionOdometry::Memory::seen() const {
  std::vector<SeenTracklet> all = window.seenTracklets(features);
  for (SeenTracklet& s : all) {
    const Eigen::Vector3d& exact = model.paired().tracklets[s.tracklet].observations.back().y;
    s.y.z() = exact.z();
  }
  return all;
}

// Labels are carried on to the newest frame, and tracklets that none of them can follow there end
// before it.
void MultimotionOdometry::Memory::cutBrokenLinks(const StereoCamera& camera,
                                                 const Options& options) {
  const std::vector<TrackletId> broken = segmenter.extend(model.measured(), camera, options);
  for (const TrackletId id : broken) trajectories.rename(id, window.cut(id));
  if (!broken.empty()) model.correct(window.window(), camera, options);
}

// The static world's tracklets tell how the camera itself errs.
void MultimotionOdometry::Memory::learnCamera(const Segmentation& segmentation,
                                              const StereoCamera& camera, const Options& options) {
  const Labeling& labeling = segmentation.labeling;
  for (std::size_t l = 0; l < labeling.labels.size(); ++l) {
    if (labeling.labels[l].id != kStatic) continue;
    const auto& estimate = segmentation.estimates[l];
    model.learnMotion(estimate ? estimate->trajectory : labeling.labels[l].trajectory,
                      labeling.support(static_cast<int>(l)), camera, options);
  }
}

MultimotionOdometry::MultimotionOdometry(const StereoCamera& camera, const Options& options)
    : camera_(camera), options_(options) {
  camera.validate();
  options.validate();
  reset();
}
MultimotionOdometry::~MultimotionOdometry() = default;
MultimotionOdometry::MultimotionOdometry(MultimotionOdometry&&) noexcept = default;
MultimotionOdometry& MultimotionOdometry::operator=(MultimotionOdometry&&) noexcept = default;

void MultimotionOdometry::reset() {
  memory_ = std::make_unique<Memory>(camera_, options_.window);
  if (known_errors_) memory_->model.startFrom(estimateOf(*known_errors_, camera_));
}

std::optional<CameraErrorReport> MultimotionOdometry::cameraErrors() const {
  const auto errors = memory_->model.errors(options_);
  if (!errors) return std::nullopt;
  return errorReport(camera_, *errors);
}

void MultimotionOdometry::setCameraErrors(const LearntCameraErrors& learnt) {
  memory_->model.startFrom(estimateOf(learnt, camera_));
  known_errors_ = learnt;
}

void MultimotionOdometry::setOptions(const Options& options) {
  options.validate();
  requireSameMemory(options_, options);
  options_ = options;
}

MultimotionEstimate MultimotionOdometry::addFrame(const Frame& frame) {
  return addFrame(prepareFrame(frame, camera_, options_.frontend));
}

MultimotionEstimate MultimotionOdometry::addFrame(PreparedFrame&& frame) {
  Memory& m = *memory_;
  const std::string complaint = complaintOf(frame, m.last_stamp_ns);
  if (!complaint.empty())
    return refused(m.next_frame, frame.stamp_ns, complaint, m.trajectories.newestPose());
  const Deadline deadline = Deadline::after(options_.engine.time_budget_ms);
  Stopwatch watch;
  m.follow(frame, camera_, options_);
  watch.lap("track");
  m.cutBrokenLinks(camera_, options_);
  watch.lap("extend");
  Segmentation segmentation = m.segmenter.segment(m.model.measured(), camera_, options_, deadline);
  watch.lap("engine");
  const Window& window = m.window.window();
  segmentation.labeling = m.trajectories.identify(window, segmentation, camera_, options_);
  m.model.addUncertainty(segmentation, camera_, options_);
  MultimotionEstimate estimate =
      m.trajectories.add(window, segmentation, m.seen(), static_cast<int>(m.features.size()),
                         frame.stamp_ns, camera_, options_);
  m.learnCamera(segmentation, camera_, options_);
  report(segmentation, estimate);
  const auto engine_laps = std::move(segmentation.timings_ms);
  m.segmenter.remember(window, std::move(segmentation));
  watch.lap("trajectories");
  estimate.timings_ms = timings(frame.prepare_ms, watch.laps(), engine_laps);
  return estimate;
}

}  // namespace mvo
