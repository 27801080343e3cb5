// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/motion_trajectories.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mvo/se3.hpp"
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

// The static world's estimate, if it has a pose in the newest frame.
const LabelEstimate* worldIn(const Segmentation& segmentation, FrameId now) {
  for (std::size_t l = 0; l < segmentation.estimates.size(); ++l) {
    const auto& e = segmentation.estimates[l];
    if (segmentation.labeling.labels[l].id == kStatic && e && e->trajectory.has(now)) return &*e;
  }
  return nullptr;
}

// Why there is no estimate of the camera.
std::string outOfSight(const Segmentation& segmentation, int points_seen, std::size_t followed) {
  std::size_t motions = 0;
  std::string world = "none of them the static world's";
  for (std::size_t l = 0; l < segmentation.estimates.size(); ++l) {
    if (segmentation.estimates[l]) ++motions;
    if (segmentation.labeling.labels[l].id == kStatic)
      world = "the static world's " +
              std::to_string(segmentation.labeling.support(static_cast<int>(l)).size()) +
              " tracklets give no pose here";
  }
  return "no estimate of the camera: " + std::to_string(points_seen) + " points seen, " +
         std::to_string(followed) + " followed from the frame before, " + std::to_string(motions) +
         " motions in the window, " + world;
}

// What is fixed to the camera (a hood, an arm, a projector's dots) is no motion: its tracklets are
// outliers, though the engine goes on to know them by their label.
Labeling withoutRiders(Labeling labeling, const std::vector<WorldEvidence>& evidence,
                       std::optional<int> world) {
  for (int& l : labeling.assignment)
    if (l != kOutlier && l != world && evidence[static_cast<std::size_t>(l)].rides) l = kOutlier;
  return labeling;
}

std::string noticeOf(bool world_is_new, bool was_lost, bool goes_on) {
  if (world_is_new)
    return "another motion is the static world from here on; the camera's pose goes on from the "
           "last one";
  if (was_lost && goes_on)
    return "the camera is found again; its pose goes on from where it was taken to be";
  if (was_lost) return "the camera is found again";
  if (goes_on)
    return "the motion of the static world was corrected by more than the camera can have moved; "
           "its pose goes on from the last one";
  return "";
}

}  // namespace

Labeling MotionTrajectories::identify(const Window& window, const Segmentation& segmentation,
                                      const StereoCamera& camera, const Options& options) {
  Labeling labeling = segmentation.labeling;
  const auto evidence = worldEvidence(window, segmentation, camera, options.noise);
  const auto world =
      world_.choose(continuity_.candidates(window, labeling, evidence), options.trajectory);
  world_is_new_ = world_is_new_ || world_.changed();
  const std::vector<LabelId> ids =
      continuity_.assign(window, withoutRiders(labeling, evidence, world), world);
  for (std::size_t l = 0; l < ids.size(); ++l) labeling.labels[l].id = ids[l];
  return labeling;
}

void MotionTrajectories::start(std::int64_t stamp_ns, MultimotionEstimate& estimate) {
  geocentric_.update(kStatic, Trajectory{0, {Eigen::Isometry3d::Identity()}, {0}},
                     Eigen::Vector3d::Zero());
  camera_.say(estimate.T_world_camera, stamp_ns, true);
  estimate.motions.push_back({});
  estimate.valid = true;
}

// The newest pose is that of the window's batch, anchored where its oldest frame is known. Where
// that would be a jump, it goes on from the last that was said.
void MotionTrajectories::placeCamera(const Segmentation& segmentation, int points_seen,
                                     const Options& options, MultimotionEstimate& estimate) {
  const FrameId now = estimate.frame;
  const LabelEstimate* world = worldIn(segmentation, now);
  CameraStep step;
  if (world == nullptr) {
    estimate.problem = outOfSight(segmentation, points_seen, estimate.points.size());
  } else {
    step = {world->trajectory.between(now - 1, now).value(), world->summary.step_covariance};
    estimate.problem = camera_.objection(step, estimate.stamp_ns, options.trajectory);
    camera_.measured(step, estimate.stamp_ns);
  }
  estimate.valid = estimate.problem.empty();
  if (!estimate.valid) {
    estimate.T_world_camera = camera_.predict(estimate.stamp_ns, options.trajectory);
    camera_.say(estimate.T_world_camera, estimate.stamp_ns, false);
    return;
  }
  const auto place = [&] {
    geocentric_.update(kStatic, world->trajectory, Eigen::Vector3d::Zero());
    estimate.T_world_camera = geocentric_.inWorld(kStatic, now).value();
  };
  // `added` is what the pose before lacks, of its right perturbation.
  const auto placeAnew = [&](const Matrix6d& added) {
    const Matrix6d Ad = adjoint(camera_.fromLastFound());
    const Matrix6d& known = covariances_[kStatic].newest();
    covariances_[kStatic].continueFrom(now - 1, Ad * known * Ad.transpose() + added);
    geocentric_.continueFrom(now - 1, camera_.newest());
    place();
  };
  const bool torn = camera_.everFound() && !geocentric_.bridges(world->trajectory);
  if (world_is_new_ || torn) {
    const Vector6d missed = geocentric_.contradiction(world->trajectory, now - 1);
    placeAnew(camera_.predictionCovariance(options.trajectory) + missed * missed.transpose());
  } else {
    place();
  }
  const bool jumps = !camera_.continues(estimate.T_world_camera, step, estimate.stamp_ns,
                                        world->summary.covariance, options.trajectory);
  if (jumps) {
    const Vector6d jump =
        log((camera_.newest() * step.T_ckm1_ck).inverse() * estimate.T_world_camera);
    placeAnew(jump * jump.transpose());
  }
  estimate.notice = noticeOf(world_is_new_, camera_.lost(), torn || jumps);
  world_is_new_ = false;
  camera_.say(estimate.T_world_camera, estimate.stamp_ns, true);
}

void MotionTrajectories::placeBodies(const Segmentation& segmentation) {
  for (std::size_t l = 0; l < segmentation.estimates.size(); ++l) {
    const LabelId id = segmentation.labeling.labels[l].id;
    const auto& e = segmentation.estimates[l];
    if (!e || id <= kStatic) continue;
    const Eigen::Vector3d origin =
        geocentric_.knows(id) ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : centroid(e->landmarks);
    geocentric_.update(id, e->trajectory, origin);
  }
}

void MotionTrajectories::growCovariances(const Segmentation& segmentation, FrameId now) {
  for (std::size_t l = 0; l < segmentation.estimates.size(); ++l) {
    const LabelId id = segmentation.labeling.labels[l].id;
    const auto& e = segmentation.estimates[l];
    if (id != kOutlier && e && e->trajectory.has(now))
      covariances_[id].update(e->trajectory, e->summary.covariance);
  }
  for (auto it = covariances_.begin(); it != covariances_.end();)
    it = geocentric_.knows(it->first) ? std::next(it) : covariances_.erase(it);
}

MultimotionEstimate MotionTrajectories::add(const Window& window, const Segmentation& segmentation,
                                            const std::vector<SeenTracklet>& seen, int points_seen,
                                            std::int64_t stamp_ns, const StereoCamera& camera,
                                            const Options& options) {
  const FrameId now = window.last_frame;
  const Labeling& labeling = segmentation.labeling;
  MultimotionEstimate estimate;
  estimate.frame = now;
  estimate.stamp_ns = stamp_ns;
  estimate.window_begin = window.first_frame;
  estimate.points = labeledPoints(window, labeling, seen);
  if (now == 0 && points_seen >= options.engine.min_tracklets)
    start(stamp_ns, estimate);
  else
    placeCamera(segmentation, points_seen, options, estimate);
  estimate.world_changes = world_.changes();
  placeBodies(segmentation);
  growCovariances(segmentation, now);
  estimate.smoothed = geocentric_.since(window.first_frame);

  for (std::size_t l = 0; l < labeling.labels.size(); ++l) {
    if (labeling.labels[l].id == kOutlier) continue;
    auto motion = newestMotion(labeling.labels[l].id, segmentation.estimates[l], now, geocentric_);
    if (!motion) {
      ++estimate.unestimated;
      continue;
    }
    motion->pose_covariance = covariances_[motion->id].newest();
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
