// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/motion_trajectories.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajectories/motion_report.hpp"

namespace mvo {

namespace {

constexpr double kInfinitelyFar = 1e-9;  // homogeneous scale below which a point has no place

// The mean of the landmarks that are not infinitely far; zero without any.
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

std::vector<LabeledPoint> labeledPoints(const Window& window, const Labeling& labeling,
                                        const std::vector<SeenTracklet>& seen) {
  std::vector<LabeledPoint> points;
  points.reserve(seen.size());
  for (const SeenTracklet& s : seen) {
    const int l = labeling.assignment[s.tracklet];
    const Tracklet& t = window.tracklets[s.tracklet];
    points.push_back({t.id, s.y, l == kOutlier ? kOutlier : labeling.labels[l].id,
                      static_cast<int>(t.observations.size())});
  }
  return points;
}

// A label's motion in the window's newest frame; none without a pose there.
std::optional<MotionEstimate> newestMotion(LabelId id, const std::optional<LabelEstimate>& estimate,
                                           FrameId now, const GeocentricTrajectories& geocentric) {
  if (!estimate || !estimate->trajectory.has(now)) return std::nullopt;
  const auto T_world_motion = geocentric.inWorld(id, now);
  if (!T_world_motion) return std::nullopt;
  const Trajectory& trajectory = estimate->trajectory;
  MotionEstimate m;
  m.id = id;
  m.T_world_motion = *T_world_motion;
  m.T_ck_c1 = *trajectory.between(now, trajectory.first_frame);
  m.T_ck_motion = *geocentric.inCamera(id, now);
  m.T_ckm1_motion = geocentric.inCamera(id, now - 1);
  m.covariance = estimate->summary.covariance;
  m.step_covariance = estimate->summary.step_covariance;
  m.first_frame = trajectory.first_frame;
  m.rms = estimate->summary.rms;
  m.converged = estimate->summary.converged;
  return m;
}

}  // namespace

Labeling MotionTrajectories::identify(const Window& window, const Segmentation& segmentation,
                                      const TrajectoryOptions& options) {
  std::vector<char> alive;
  alive.reserve(segmentation.estimates.size());
  for (const auto& e : segmentation.estimates)
    alive.push_back(e && e->trajectory.has(window.last_frame) ? 1 : 0);
  Labeling labeling = segmentation.labeling;
  const std::vector<LabelId> ids = continuity_.assign(window, labeling, options, alive);
  for (std::size_t l = 0; l < ids.size(); ++l) labeling.labels[l].id = ids[l];
  return labeling;
}

// The static world comes first: bodies are placed in it.
void MotionTrajectories::place(const Segmentation& segmentation) {
  for (const bool world : {true, false})
    for (std::size_t l = 0; l < segmentation.estimates.size(); ++l) {
      const LabelId id = segmentation.labeling.labels[l].id;
      const auto& e = segmentation.estimates[l];
      if (!e || (id == kStatic) != world) continue;
      const bool placed = world || geocentric_.knows(id);
      const Eigen::Vector3d origin =
          placed ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : centroid(e->landmarks);
      geocentric_.update(id, e->trajectory, origin);
    }
}

MultimotionEstimate MotionTrajectories::add(const Window& window, const Segmentation& segmentation,
                                            const std::vector<SeenTracklet>& seen, int points_seen,
                                            const StereoCamera& camera, const Options& options) {
  const FrameId now = window.last_frame;
  const Labeling& labeling = segmentation.labeling;
  place(segmentation);
  MultimotionEstimate estimate;
  estimate.frame = now;
  estimate.window_begin = window.first_frame;
  estimate.points = labeledPoints(window, labeling, seen);
  if (now == 0 && points_seen >= options.engine.min_tracklets) {
    geocentric_.update(kStatic, Trajectory{0, {Eigen::Isometry3d::Identity()}, {0}},
                       Eigen::Vector3d::Zero());
    estimate.motions.push_back({});
  }
  estimate.smoothed = geocentric_.since(window.first_frame);

  for (std::size_t l = 0; l < labeling.labels.size(); ++l) {
    auto motion = newestMotion(labeling.labels[l].id, segmentation.estimates[l], now, geocentric_);
    if (!motion) {
      ++estimate.unestimated;
      continue;
    }
    motion->support = static_cast<int>(labeling.support(static_cast<int>(l)).size());
    reportPoints(estimate.points, camera, options.frontend.min_disparity, *motion);
    estimate.motions.push_back(*motion);
  }
  std::sort(estimate.motions.begin(), estimate.motions.end(),
            [](const MotionEstimate& a, const MotionEstimate& b) { return a.id < b.id; });
  if (!estimate.motions.empty() && estimate.motions.front().id == kStatic) {
    const Matrix6d of_camera = estimate.motions.front().covariance;
    for (MotionEstimate& m : estimate.motions)
      m.significance = significanceOf(m, now, of_camera, estimate.smoothed);
  }
  estimate.departed =
      lifetimes_.update(now, window.first_frame, continuity_.resting(window), estimate.motions);
  geocentric_.forgetBefore(window.first_frame);
  geocentric_.forgetBodies(window.first_frame, continuity_.remembered());
  return estimate;
}

}  // namespace mvo
