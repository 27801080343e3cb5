// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/link_residual.hpp"
#include "engine/proposal.hpp"
#include "frontend/feature_tracker.hpp"
#include "frontend/rolling_shutter.hpp"
#include "frontend/tracklet_window.hpp"
#include "mvo/segment_motions.hpp"
#include "stopwatch.hpp"
#include "tracklet_map.hpp"
#include "trajectories/geocentric.hpp"
#include "trajectories/label_continuity.hpp"
#include "trajectories/motion_lifetimes.hpp"
#include "trajectories/uncertainty.hpp"

namespace mvo {

namespace {

constexpr std::size_t kTrimmedShare = 20;  // one of so many points on each side
constexpr double kInfinitelyFar = 1e-9;    // homogeneous scale below which a point has no place

std::string sizeText(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

// Of the landmarks that are not infinitely far.
Eigen::Vector3d centroid(const LandmarkMap& landmarks) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int near = 0;
  for (const auto& [id, p] : landmarks.p_c)
    if (std::abs(p.w()) > kInfinitelyFar) {
      sum += p.hnormalized();
      ++near;
    }
  if (near > 0) sum /= near;
  return sum;
}

// What is wrong with a frame's images, or an empty string.
std::string complaint(const Frame& frame, const StereoCamera& camera) {
  const std::string expected = std::to_string(camera.width) + "x" + std::to_string(camera.height);
  const auto wrong = [&camera](const cv::Mat& m) {
    return m.cols != camera.width || m.rows != camera.height;
  };
  if (frame.left.empty()) return "the left image is empty";
  if (frame.right.empty() == frame.depth.empty())
    return "a frame needs either a right image or a depth image";
  if (frame.left.type() != CV_8UC1) return "the left image is not 8-bit grey";
  if (!frame.right.empty() && frame.right.type() != CV_8UC1)
    return "the right image is not 8-bit grey";
  if (!frame.depth.empty() && frame.depth.type() != CV_32FC1)
    return "the depth image is not 32-bit float";
  if (wrong(frame.left))
    return "the left image is " + sizeText(frame.left) + ", the calibration says " + expected;
  if (!frame.right.empty() && wrong(frame.right))
    return "the right image is " + sizeText(frame.right) + ", the calibration says " + expected;
  if (!frame.depth.empty() && wrong(frame.depth))
    return "the depth image is " + sizeText(frame.depth) + ", the calibration says " + expected;
  return "";
}

}  // namespace

struct MultimotionOdometry::State {
  State(const StereoCamera& c, const Options& o)
      : camera(c),
        options(o),
        tracker(c, o.frontend, o.window.max_gap),
        window(o.window),
        shutter(c, o),
        continuity(o.trajectory) {}

  TrackingPrior prior() const;
  WarmStart warmStart() const;
  void steadyWindow();
  const Window& measured() const { return steady ? *steady : window.window(); }
  void cutBrokenLinks(WarmStart& start);
  void place(const Segmentation& segmentation, const std::vector<LabelId>& ids);
  void remember(Segmentation segmentation, const std::vector<LabelId>& ids);
  void report(const Segmentation& segmentation, const std::vector<LabelId>& ids,
              const std::vector<Feature>& features, MultimotionEstimate& estimate);
  void reportPoints(MotionEstimate& motion, const std::vector<LabeledPoint>& points) const;
  void reportSignificance(MultimotionEstimate& estimate) const;

  StereoCamera camera;
  Options options;
  FeatureTracker tracker;
  TrackletWindow window;
  RollingShutter shutter;
  std::optional<Window> steady;  // as a global shutter would have seen it, where that differs
  LabelContinuity continuity;
  GeocentricTrajectories geocentric;
  MotionLifetimes lifetimes;
  FrameId next_frame = 0;
  std::int64_t last_stamp_ns = -1;
  std::vector<Feature> features;       // of the last frame
  std::vector<Label> labels;           // of the last window
  std::vector<LandmarkMap> landmarks;  // parallel to labels
  double typical_residual = 0;         // of the last window [px]
  TrackletMap<int> label_of;           // tracklet -> index into labels
};

// Constant velocity: of each point's label, of an outlier's own image motion, and for new points
// that of what is seen next to them.
TrackingPrior MultimotionOdometry::State::prior() const {
  TrackingPrior prior;
  std::vector<std::optional<Eigen::Isometry3d>> T_next_last;
  for (const Label& label : labels)
    T_next_last.push_back(label.trajectory.between(next_frame - 1, next_frame - 2));
  const auto carried = [&](const Eigen::Vector3d& y, int l) -> std::optional<Eigen::Vector3d> {
    if (!T_next_last[l] || y.x() - y.z() < options.frontend.min_disparity) return std::nullopt;
    const Eigen::Vector3d p = *T_next_last[l] * camera.backProject(y);
    return p.z() > 0 ? std::make_optional(camera.project(p)) : std::nullopt;
  };

  struct Followed {
    Eigen::Vector2d uv;
    int label;             // or kOutlier
    Eigen::Vector3d step;  // image motion since the last frame, of outliers
  };
  std::vector<Followed> followed;
  std::vector<const Feature*> fresh;
  for (const Feature& f : features) {
    const TrackletId id = window.trackletOf(f.id);
    const auto index = window.find(id);
    if (!index) {
      fresh.push_back(&f);
      continue;
    }
    const auto it = label_of.find(id);
    const auto& o = window.window().tracklets[*index].observations;
    const Eigen::Vector3d step = (o.back().y - o[o.size() - 2].y) /
                                 static_cast<double>(o.back().frame - o[o.size() - 2].frame);
    followed.push_back({f.y.head<2>(), it == label_of.end() ? kOutlier : it->second, step});
    // What follows no known motion may be a body of its own: it wants as many points as a known
    // one.
    if (it == label_of.end() || labels[it->second].id > kStatic) prior.dense[f.id] = true;
    const auto next = it == label_of.end() ? std::optional<Eigen::Vector3d>(f.y + step)
                                           : carried(f.y, it->second);
    if (next) prior.predicted[f.id] = *next;
  }
  for (const Feature* f : fresh) {
    const auto nearest = std::min_element(
        followed.begin(), followed.end(), [f](const Followed& a, const Followed& b) {
          return (a.uv - f->y.head<2>()).squaredNorm() < (b.uv - f->y.head<2>()).squaredNorm();
        });
    if (nearest == followed.end()) break;
    const auto next = nearest->label == kOutlier
                          ? std::optional<Eigen::Vector3d>(f->y + nearest->step)
                          : carried(f->y, nearest->label);
    if (next) prior.predicted[f->id] = *next;
  }
  return prior;
}

WarmStart MultimotionOdometry::State::warmStart() const {
  WarmStart start;
  start.labels = labels;
  start.landmarks = landmarks;
  start.typical_residual = typical_residual;
  for (const Tracklet& t : window.window().tracklets) {
    const auto it = label_of.find(t.id);
    start.assignment.push_back(it == label_of.end() ? kOutlier : it->second);
  }
  return start;
}

void MultimotionOdometry::State::steadyWindow() {
  steady.reset();
  if (shutter.readout() != 0) steady = shutter.withGlobalShutter(window.window());
}

// A newest link that is bad under every label is a wrong match or the start of a motion: the
// tracklet ends before it.
void MultimotionOdometry::State::cutBrokenLinks(WarmStart& start) {
  const LinkResidual residual(camera, options.noise, options.energy.residual);
  const FrameId now = window.window().last_frame;
  std::vector<TrackletId> broken;
  for (std::size_t p = 0; p < start.assignment.size(); ++p) {
    const Tracklet& t = measured().tracklets[p];
    if (start.assignment[p] == kOutlier || t.last() != now || t.observations.size() < 3) continue;
    const Observation& b = t.observations.back();
    const Observation& a = *(&b - 1);
    double best = std::numeric_limits<double>::infinity();
    for (const Label& label : start.labels)
      if (const auto T = label.trajectory.between(b.frame, a.frame))
        best = std::min(best, residual(*T, a.y, b.y));
    if (std::isfinite(best) && best > options.energy.threshold) broken.push_back(t.id);
  }
  for (const TrackletId id : broken) continuity.rename(id, window.cut(id));
  if (!broken.empty()) {
    std::vector<Label> extended = std::move(start.labels);
    start = warmStart();
    start.labels = std::move(extended);
    steadyWindow();
  }
}

// The static world first: bodies are placed in it.
void MultimotionOdometry::State::place(const Segmentation& segmentation,
                                       const std::vector<LabelId>& ids) {
  for (const bool world : {true, false})
    for (std::size_t l = 0; l < ids.size(); ++l) {
      const auto& e = segmentation.estimates[l];
      if (!e || (ids[l] == kStatic) != world) continue;
      const bool placed = world || geocentric.knows(ids[l]);
      const Eigen::Vector3d origin =
          placed ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : centroid(e->landmarks);
      geocentric.update(ids[l], e->trajectory, origin);
    }
}

void MultimotionOdometry::State::remember(Segmentation segmentation,
                                          const std::vector<LabelId>& ids) {
  labels.clear();
  landmarks.clear();
  typical_residual = segmentation.typical_residual;
  label_of.clear();
  Labeling& labeling = segmentation.labeling;
  for (std::size_t l = 0; l < ids.size(); ++l) {
    auto& estimate = segmentation.estimates[l];
    labels.push_back({ids[l], std::move(estimate ? estimate->trajectory  //
                                                 : labeling.labels[l].trajectory)});
    landmarks.push_back(estimate ? std::move(estimate->landmarks) : LandmarkMap{});
  }
  for (std::size_t p = 0; p < labeling.assignment.size(); ++p)
    if (labeling.assignment[p] != kOutlier)
      label_of.set(window.window().tracklets[p].id, labeling.assignment[p]);
}

void MultimotionOdometry::State::report(const Segmentation& segmentation,
                                        const std::vector<LabelId>& ids,
                                        const std::vector<Feature>& seen,
                                        MultimotionEstimate& estimate) {
  const FrameId now = estimate.frame;
  const Window& w = window.window();
  estimate.points.reserve(seen.size());
  for (const Feature& f : seen) {
    const auto index = window.find(window.trackletOf(f.id));
    if (!index) continue;
    const int l = segmentation.labeling.assignment[*index];
    const Tracklet& t = w.tracklets[*index];
    estimate.points.push_back(
        {t.id, f.y, l == kOutlier ? kOutlier : ids[l], static_cast<int>(t.observations.size())});
  }
  std::vector<int> support(ids.size(), 0);
  for (const int l : segmentation.labeling.assignment)
    if (l != kOutlier) ++support[l];
  for (std::size_t l = 0; l < ids.size(); ++l) {
    const auto& e = segmentation.estimates[l];
    const auto T_world_motion =
        e && e->trajectory.has(now) ? geocentric.inWorld(ids[l], now) : std::nullopt;
    if (!T_world_motion) {
      ++estimate.unestimated;
      continue;
    }
    MotionEstimate m;
    m.id = ids[l];
    m.T_world_motion = *T_world_motion;
    m.T_ck_c1 = *e->trajectory.between(now, e->trajectory.first_frame);
    m.T_ck_motion = *geocentric.inCamera(ids[l], now);
    m.T_ckm1_motion = geocentric.inCamera(ids[l], now - 1);
    m.covariance = e->summary.covariance;
    m.step_covariance = e->summary.step_covariance;
    m.first_frame = e->trajectory.first_frame;
    m.rms = e->summary.rms;
    m.converged = e->summary.converged;
    m.support = support[l];
    reportPoints(m, estimate.points);
    estimate.motions.push_back(m);
  }
  std::sort(estimate.motions.begin(), estimate.motions.end(),
            [](const MotionEstimate& a, const MotionEstimate& b) { return a.id < b.id; });
  estimate.window_begin = w.first_frame;
  estimate.smoothed = geocentric.since(w.first_frame);
  reportSignificance(estimate);
}

// Where a motion's points of this frame are.
void MultimotionOdometry::State::reportPoints(MotionEstimate& motion,
                                              const std::vector<LabeledPoint>& points) const {
  const Eigen::Isometry3d T_motion_ck = motion.T_ck_motion.inverse();
  const Eigen::Isometry3d T_world_ck =
      motion.id == kStatic ? motion.T_world_motion : motion.T_world_motion * T_motion_ck;
  Eigen::Vector3d sum_ck = Eigen::Vector3d::Zero();
  std::array<std::vector<double>, 3> along;  // x, y, z of the motion's frame
  for (const LabeledPoint& p : points) {
    if (p.id != motion.id) continue;
    ++motion.visible;
    if (p.y.x() - p.y.z() <= options.frontend.min_disparity) continue;
    const Eigen::Vector3d p_ck = camera.backProject(p.y);
    sum_ck += p_ck;
    const Eigen::Vector3d p_motion = T_motion_ck * p_ck;
    for (int axis = 0; axis < 3; ++axis) along[axis].push_back(p_motion[axis]);
  }
  const std::size_t near = along[0].size();
  if (near == 0) return;
  motion.centroid_world = T_world_ck * (sum_ck / static_cast<double>(near));
  const std::size_t trimmed = near / kTrimmedShare;
  for (int axis = 0; axis < 3; ++axis) {
    const auto least = along[axis].begin() + static_cast<std::ptrdiff_t>(trimmed);
    const auto most = along[axis].end() - 1 - static_cast<std::ptrdiff_t>(trimmed);
    std::nth_element(along[axis].begin(), least, along[axis].end());
    motion.extent_motion.min()[axis] = *least;
    std::nth_element(least, most, along[axis].end());
    motion.extent_motion.max()[axis] = *most;
  }
}

// The largest distance from any earlier pose of the window, of which the first is held and the
// others are about as uncertain as the newest.
void MultimotionOdometry::State::reportSignificance(MultimotionEstimate& estimate) const {
  if (estimate.motions.empty() || estimate.motions.front().id != kStatic) return;
  const Matrix6d of_camera = estimate.motions.front().covariance;
  for (MotionEstimate& m : estimate.motions) {
    const Matrix6d sum = m.id == kStatic ? m.covariance : Matrix6d(m.covariance + of_camera);
    const Matrix6d covariance =
        stepCovariance(m.id == kStatic ? Eigen::Isometry3d::Identity() : m.T_ck_motion, sum);
    const RestDistance from_first(covariance);
    const RestDistance from_later(2 * covariance);
    for (const SmoothedPose& past : estimate.smoothed)
      if (past.id == m.id && past.frame < estimate.frame)
        m.significance =
            std::max(m.significance, (past.frame == m.first_frame ? from_first : from_later)(
                                         past.T_world_motion.inverse() * m.T_world_motion));
  }
}

MultimotionOdometry::MultimotionOdometry(const StereoCamera& camera, const Options& options)
    : camera_(camera), preparation_(options.frontend) {
  camera.validate();
  options.validate();
  state_ = std::make_unique<State>(camera, options);
}
MultimotionOdometry::~MultimotionOdometry() = default;
MultimotionOdometry::MultimotionOdometry(MultimotionOdometry&&) noexcept = default;
MultimotionOdometry& MultimotionOdometry::operator=(MultimotionOdometry&&) noexcept = default;

void MultimotionOdometry::reset() {
  state_ = std::make_unique<State>(state_->camera, state_->options);
}

void MultimotionOdometry::setOptions(const Options& options) {
  options.validate();
  requireSameMemory(state_->options, options);
  state_->options = options;
  state_->tracker.setOptions(options.frontend);
  state_->continuity.setOptions(options.trajectory);
}

PreparedFrame MultimotionOdometry::prepare(const Frame& frame) const {
  Stopwatch watch;
  PreparedFrame prepared;
  prepared.stamp_ns = frame.stamp_ns;
  prepared.problem = complaint(frame, camera_);
  if (prepared.problem.empty())
    prepared.images = std::make_shared<FrameImages>(prepareImages(frame, preparation_));
  watch.lap("prepare");
  prepared.prepare_ms = watch.total();
  return prepared;
}

MultimotionEstimate MultimotionOdometry::addFrame(const Frame& frame) {
  return addPrepared(prepare(frame));
}

MultimotionEstimate MultimotionOdometry::addPrepared(PreparedFrame&& frame) {
  State& s = *state_;
  const Deadline deadline = Deadline::after(s.options.engine.time_budget_ms);
  Stopwatch watch;
  MultimotionEstimate estimate;
  estimate.frame = s.next_frame;
  estimate.stamp_ns = frame.stamp_ns;
  estimate.problem = frame.problem;
  if (frame.problem.empty() && frame.stamp_ns <= s.last_stamp_ns)
    estimate.problem = "the stamp goes back or stands still: " + std::to_string(frame.stamp_ns) +
                       " ns after " + std::to_string(s.last_stamp_ns) + " ns";
  if (!estimate.problem.empty()) return estimate;
  s.last_stamp_ns = frame.stamp_ns;

  const bool sensed_depth = !frame.images->depth.empty();
  const std::vector<Feature> features = s.tracker.track(std::move(*frame.images), s.prior());
  s.shutter.addFrame(s.next_frame, 1e-9 * static_cast<double>(frame.stamp_ns), sensed_depth);
  s.window.add(s.next_frame++, features);
  s.steadyWindow();
  watch.lap("track");

  WarmStart start = s.warmStart();
  start.labels =
      extendLabels(s.measured(), s.camera, {start.labels, start.assignment}, s.options).labels;
  s.cutBrokenLinks(start);
  watch.lap("extend");
  Segmentation segmentation =
      s.options.engine.engine == Engine::kSequentialRansac
          ? sequentialRansac(s.measured(), s.camera, s.options)
          : segmentMotions(s.measured(), s.camera, std::move(start), s.options, deadline);
  watch.lap("engine");

  std::vector<char> alive;
  for (const auto& e : segmentation.estimates)
    alive.push_back(e && e->trajectory.has(estimate.frame) ? 1 : 0);
  const std::vector<LabelId> ids =
      s.continuity.assign(s.window.window(), segmentation.labeling, alive);
  s.place(segmentation, ids);
  const bool first =
      estimate.frame == 0 && static_cast<int>(features.size()) >= s.options.engine.min_tracklets;
  if (first)
    s.geocentric.update(kStatic, Trajectory{0, {Eigen::Isometry3d::Identity()}, {0}},
                        Eigen::Vector3d::Zero());
  s.report(segmentation, ids, features, estimate);
  if (first) estimate.motions.push_back({});
  const Window& window = s.window.window();
  estimate.departed = s.lifetimes.update(estimate.frame, window.first_frame,
                                         s.continuity.resting(window), estimate.motions);
  const Labeling& labeling = segmentation.labeling;
  for (std::size_t l = 0; l < ids.size(); ++l)
    if (ids[l] == kStatic)
      s.shutter.learn(window,
                      segmentation.estimates[l] ? segmentation.estimates[l]->trajectory
                                                : labeling.labels[l].trajectory,
                      labeling.support(static_cast<int>(l)));
  estimate.rounds = segmentation.rounds;
  estimate.converged = segmentation.converged;
  estimate.cut_short = segmentation.cut_short;
  const auto engine_laps = std::move(segmentation.timings_ms);
  s.remember(std::move(segmentation), ids);
  s.geocentric.forgetBefore(window.first_frame);
  s.geocentric.forgetBodies(window.first_frame, s.continuity.remembered());
  s.features = features;

  estimate.valid = !estimate.motions.empty() && estimate.motions.front().id == kStatic;
  if (!estimate.valid)
    estimate.problem = "no estimate of the camera: " + std::to_string(features.size()) +
                       " points seen, " + std::to_string(estimate.points.size()) +
                       " followed from the frame before";
  watch.lap("trajectories");
  estimate.timings_ms.emplace_back("prepare", frame.prepare_ms);
  double total = frame.prepare_ms;
  for (const auto& [stage, ms] : watch.laps()) {
    if (stage == "engine")
      for (const auto& lap : engine_laps) estimate.timings_ms.push_back(lap);
    else
      estimate.timings_ms.emplace_back(stage, ms);
    total += ms;
  }
  estimate.timings_ms.emplace_back("total", total);
  return estimate;
}

}  // namespace mvo
