// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/world_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "statistics.hpp"

namespace mvo {

namespace {

constexpr int kColumns = 8;  // of the grid that tells how far around a label reaches
constexpr int kRows = 6;
constexpr double kNeighborhood = 0.08;  // image widths within which points are neighbours
constexpr double kDepthStep = 0.05;     // relative difference of disparities that is one of depth
constexpr double kFewVotes = 4;         // tracklets that are added to those which vote on depth
constexpr double kAtRest = 0.5;         // median displacement of a label that rests [px]
constexpr double kMoving = 4;           // that it would have by the motion that does not [px]
constexpr FrameId kRestSpan = 5;        // frames that a tracklet needs to tell rest from motion
constexpr int kLarge = 20;              // tracklets of a motion beside which another rides
constexpr double kNotBehind = 0.2;  // up to which a label may ride: what rests behind is a world

struct Seen {
  const Tracklet* tracklet = nullptr;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  // in the newest frame [px]
  int label = kOutlier;

  double disparity() const { return y.x() - y.z(); }
};

std::vector<Seen> seenTracklets(const Window& window, const Labeling& labeling) {
  std::vector<Seen> seen;
  for (std::size_t p = 0; p < window.tracklets.size(); ++p) {
    const Tracklet& t = window.tracklets[p];
    if (t.observations.empty() || t.last() != window.last_frame) continue;
    seen.push_back({&t, t.observations.back().y, labeling.assignment[p]});
  }
  return seen;
}

void reachAround(const std::vector<Seen>& seen, const StereoCamera& camera,
                 std::vector<WorldEvidence>& evidence) {
  std::vector<std::vector<char>> cells(evidence.size(), std::vector<char>(kColumns * kRows, 0));
  std::vector<char> any(kColumns * kRows, 0);
  for (const Seen& s : seen) {
    const int column =
        std::clamp(static_cast<int>(s.y.x() * kColumns / camera.width), 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(s.y.y() * kRows / camera.height), 0, kRows - 1);
    any[row * kColumns + column] = 1;
    if (s.label != kOutlier) cells[s.label][row * kColumns + column] = 1;
  }
  const auto occupied = static_cast<double>(std::count(any.begin(), any.end(), 1));
  for (std::size_t l = 0; l < evidence.size() && occupied > 0; ++l)
    evidence[l].around =
        static_cast<double>(std::count(cells[l].begin(), cells[l].end(), 1)) / occupied;
}

// The nearest point of another label within `reach` pixels; none, or of several alike the first.
const Seen* nearestOther(const std::vector<Seen>& by_column, std::size_t i, double reach) {
  const Seen& s = by_column[i];
  const Seen* neighbor = nullptr;
  double nearest = reach * reach;
  const auto visit = [&](const Seen& other) {
    const double across = other.y.x() - s.y.x();
    if (across * across >= nearest) return false;
    const double distance = (other.y - s.y).head<2>().squaredNorm();
    if (other.label == s.label || distance >= nearest) return true;
    nearest = distance;
    neighbor = &other;
    return true;
  };
  for (std::size_t j = i; j > 0 && visit(by_column[j - 1]);) --j;
  for (std::size_t j = i + 1; j < by_column.size() && visit(by_column[j]);) ++j;
  return neighbor;
}

// Each point votes with its nearest neighbour of another label, if that is near.
void lieBehind(std::vector<Seen> seen, const StereoCamera& camera, const NoiseOptions& noise,
               std::vector<WorldEvidence>& evidence) {
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Seen& a, const Seen& b) { return a.y.x() < b.y.x(); });
  const double certain = 3 * std::sqrt(2.0) * noise.disparity;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Seen& s = seen[i];
    if (s.label == kOutlier) continue;
    const Seen* neighbor = nearestOther(seen, i, kNeighborhood * camera.width);
    if (neighbor == nullptr) continue;
    ++evidence[s.label].votes;
    const double nearer = neighbor->disparity() - s.disparity();
    if (std::abs(nearer) > std::max(certain, kDepthStep * s.disparity()))
      evidence[s.label].behind += nearer > 0 ? 1 : -1;
  }
  for (WorldEvidence& e : evidence) e.behind /= e.seen + kFewVotes;
}

const Trajectory* trajectoryOf(const Segmentation& segmentation, std::size_t label) {
  const auto& estimate = segmentation.estimates[label];
  return estimate ? &estimate->trajectory : nullptr;
}

// How far a label's points have moved in the image since they were first seen, as observed, or as
// they would have by a motion; the median of those long enough, none without three [px].
std::optional<double> displacement(const std::vector<Seen>& seen, int label,
                                   const Trajectory* motion, const StereoCamera& camera) {
  std::vector<double> distances;
  for (const Seen& s : seen) {
    if (s.label != label || s.tracklet->last() - s.tracklet->first() < kRestSpan) continue;
    const Observation& first = s.tracklet->observations.front();
    Eigen::Vector3d now = s.y;
    if (motion != nullptr) {
      const auto T_now_first = motion->between(s.tracklet->last(), first.frame);
      if (!T_now_first || first.y.x() - first.y.z() <= 0) continue;
      const Eigen::Vector3d p = *T_now_first * camera.backProject(first.y);
      if (p.z() <= 0) continue;
      now = camera.project(p);
    }
    distances.push_back((now - first.y).head<2>().norm());
  }
  if (distances.size() < 3) return std::nullopt;
  return median(std::move(distances));
}

void rideAlong(const std::vector<Seen>& seen, const Segmentation& segmentation,
               const StereoCamera& camera, std::vector<WorldEvidence>& evidence) {
  for (std::size_t l = 0; l < evidence.size(); ++l) {
    if (evidence[l].behind > kNotBehind) continue;
    const auto own = displacement(seen, static_cast<int>(l), nullptr, camera);
    if (!own || *own > kAtRest) continue;
    for (std::size_t m = 0; m < evidence.size() && !evidence[l].rides; ++m) {
      const Trajectory* motion = trajectoryOf(segmentation, m);
      if (m == l || motion == nullptr || evidence[m].seen < kLarge ||
          evidence[m].around <= evidence[l].around)
        continue;
      const auto there = displacement(seen, static_cast<int>(l), motion, camera);
      evidence[l].rides = there && *there > kMoving;
    }
  }
}

}  // namespace

std::vector<WorldEvidence> worldEvidence(const Window& window, const Segmentation& segmentation,
                                         const StereoCamera& camera, const NoiseOptions& noise) {
  const std::size_t count = segmentation.labeling.labels.size();
  std::vector<WorldEvidence> evidence(count);
  const std::vector<Seen> seen = seenTracklets(window, segmentation.labeling);
  for (const Seen& s : seen)
    if (s.label != kOutlier) ++evidence[s.label].seen;
  for (std::size_t l = 0; l < count; ++l) {
    const Trajectory* trajectory = trajectoryOf(segmentation, l);
    evidence[l].alive = trajectory != nullptr && trajectory->has(window.last_frame);
  }
  reachAround(seen, camera, evidence);
  lieBehind(seen, camera, noise, evidence);
  rideAlong(seen, segmentation, camera, evidence);
  return evidence;
}

}  // namespace mvo
