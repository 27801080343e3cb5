// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Windows of tracklets with exact truth and without images: a moving stereo camera, a static world,
// balls that move as they are told, gross outliers, noise, points that come, go, hide and skip
// frames.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mvo/se3.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo::test {

/// A ball with points on it. Moves about its centre by `step` per frame while it is awake.
struct SyntheticBody {
  Eigen::Vector3d center = Eigen::Vector3d::UnitZ() * 4;  ///< in the world at rest [m]
  double radius = 0.45;                                   ///< [m]
  int points = 40;                                        ///< followed at once
  Vector6d step = Vector6d::Zero();                       ///< (rho [m], phi [rad]), world axes
  int wakes = 0;                                          ///< frame before its first step
  int appears = 0;                                        ///< first frame that sees it
  int vanishes = std::numeric_limits<int>::max();         ///< first frame that does not any more
};

struct SyntheticOptions {
  StereoCamera camera{500, 500, 319.5, 239.5, 0.24, 640, 480};
  int frames = 24;
  int static_points = 150;  ///< followed at once, 3 m to 9 m away
  std::vector<SyntheticBody> bodies;
  int outliers = 10;        ///< followed at once, each jumps anew in every frame
  double jump = 8;          ///< standard deviation [px]
  double noise = 0.1;       ///< of u_l and v [px]
  double disparity = 0.12;  ///< noise of u_l - u_r [px]
  int min_length = 8;       ///< frames that a point is followed for, if nothing hides it
  int max_length = 60;
  double gaps = 0.01;  ///< share of observations that are missing within a tracklet
  Vector6d camera_step = (Vector6d() << 0.004, 0.001, 0.012, 0.0004, 0.002, 0.0003).finished();
  unsigned seed = 1;
};

struct SyntheticWindow {
  StereoCamera camera;
  Window window;
  std::vector<int> truth;  ///< per tracklet: 0 = static, i + 1 = body i, kOutlier
  std::vector<std::vector<Eigen::Isometry3d>> T_ck_c0;  ///< per label, every frame from 0

  /// ^lT_ca_cb of the truth.
  Eigen::Isometry3d between(int label, FrameId a, FrameId b) const {
    const auto& T = T_ck_c0.at(label);
    return T.at(a) * T.at(b).inverse();
  }
  /// The truth as a hypothesis over the window's frames.
  Trajectory trajectory(int label) const {
    Trajectory t;
    t.first_frame = window.first_frame;
    for (FrameId k = window.first_frame; k <= window.last_frame; ++k) {
      t.T_ck_c1.push_back(between(label, k, window.first_frame));
      t.segment.push_back(0);
    }
    return t;
  }
  std::vector<int> members(int label) const { return Labeling{{}, truth}.support(label); }
};

/// Makes a SyntheticWindow frame by frame.
class SyntheticScene {
 public:
  explicit SyntheticScene(const SyntheticOptions& options) : o_(options), random_(options.seed) {}

  SyntheticWindow make() {
    std::vector<int> slots(o_.static_points, 0);
    for (std::size_t i = 0; i < o_.bodies.size(); ++i)
      slots.insert(slots.end(), o_.bodies[i].points, static_cast<int>(i) + 1);
    slots.insert(slots.end(), o_.outliers, kOutlier);
    std::vector<Point> points(slots.size());
    std::map<TrackletId, std::pair<int, Tracklet>> tracklets;
    TrackletId next = 0;
    for (int k = 0; k < o_.frames; ++k)
      for (std::size_t s = 0; s < slots.size(); ++s) {
        Point& point = points[s];
        if (k > 0 && point.alive) point.alive = k <= point.last && step(point, slots[s], k);
        if (!point.alive) {
          point = born(slots[s], k);
          point.id = next++;
        }
        if (!point.alive || (point.seen && uniform(0, 1) < o_.gaps)) {
          point.seen = false;
          continue;
        }
        point.seen = true;
        auto& [truth, tracklet] = tracklets[point.id];
        truth = slots[s];
        tracklet.id = point.id;
        tracklet.observations.push_back({k, noisy(point.y)});
      }
    SyntheticWindow result{o_.camera, {0, o_.frames - 1, {}}, {}, {}};
    for (auto& [id, entry] : tracklets) {
      result.truth.push_back(entry.first);
      result.window.tracklets.push_back(std::move(entry.second));
    }
    for (int l = 0; l <= static_cast<int>(o_.bodies.size()); ++l) {
      result.T_ck_c0.emplace_back();
      for (int k = 0; k < o_.frames; ++k)
        result.T_ck_c0.back().push_back(cameraAt(k).inverse() * bodyAt(l, k) *
                                        bodyAt(l, 0).inverse() * cameraAt(0));
    }
    return result;
  }

 private:
  struct Point {
    bool alive = false;
    bool seen = false;  // in the last frame
    int last = -1;
    TrackletId id = -1;
    Eigen::Vector3d p_b = Eigen::Vector3d::Zero();  // in its body, the world's for static ones
    Eigen::Vector3d y = Eigen::Vector3d::Zero();
  };

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double gauss(double sigma) { return sigma * normal_(random_); }

  Eigen::Isometry3d cameraAt(int k) const { return exp(k * o_.camera_step); }  // T_world_ck
  Eigen::Isometry3d bodyAt(int label, int k) const {                           // T_world_body
    if (label <= 0) return Eigen::Isometry3d::Identity();
    const SyntheticBody& body = o_.bodies[label - 1];
    return Eigen::Translation3d(body.center) * exp(std::max(0, k - body.wakes) * body.step);
  }
  bool present(const SyntheticBody& body, int k) const {
    return k >= body.appears && k < body.vanishes;
  }

  Eigen::Vector3d noisy(const Eigen::Vector3d& y) {
    const double u = y.x() + gauss(o_.noise);
    const double v = y.y() + gauss(o_.noise);
    return {u, v, u - (y.x() - y.z()) + gauss(o_.disparity)};
  }
  bool inImage(const Eigen::Vector3d& y) const {
    return y.z() > 1 && y.x() < o_.camera.width - 1 && y.y() > 1 && y.y() < o_.camera.height - 1;
  }

  // Behind another ball?
  bool hidden(const Eigen::Vector3d& p_c, int label, int k) const {
    for (int other = 1; other <= static_cast<int>(o_.bodies.size()); ++other) {
      const SyntheticBody& body = o_.bodies[other - 1];
      if (other == label || !present(body, k)) continue;
      const Eigen::Vector3d c = cameraAt(k).inverse() * bodyAt(other, k).translation();
      if (p_c.z() > c.z() && p_c.normalized().cross(c).norm() < 1.05 * body.radius) return true;
    }
    return false;
  }

  // Moves a point on to a frame; false if it cannot be seen there.
  bool step(Point& point, int label, int k) {
    if (label == kOutlier) {
      const double du = gauss(o_.jump);
      point.y += Eigen::Vector3d(du, gauss(o_.jump), du);
      return inImage(point.y);
    }
    const Eigen::Vector3d p_c = cameraAt(k).inverse() * bodyAt(label, k) * point.p_b;
    if (p_c.z() < 0.3 || hidden(p_c, label, k)) return false;
    if (label > 0) {
      const Eigen::Vector3d c = cameraAt(k).inverse() * bodyAt(label, k).translation();
      if (!present(o_.bodies[label - 1], k) ||
          (p_c - c).dot(p_c) > -0.2 * (p_c - c).norm() * p_c.norm())
        return false;
    }
    point.y = o_.camera.project(p_c);
    return inImage(point.y);
  }

  Point born(int label, int k) {
    Point point;
    point.last = k + std::uniform_int_distribution<int>(o_.min_length, o_.max_length)(random_) - 1;
    constexpr int kTries = 50;
    for (int attempt = 0; attempt < kTries && !point.alive; ++attempt) {
      const double depth = uniform(3, 9);
      const double u = uniform(0, o_.camera.width);
      point.y = {u, uniform(0, o_.camera.height), o_.camera.rightColumn(u, depth)};
      if (label == 0) point.p_b = cameraAt(k) * o_.camera.backProject(point.y);
      if (label > 0)
        point.p_b = o_.bodies[label - 1].radius *
                    Eigen::Vector3d(gauss(1), gauss(1), gauss(1)).normalized();
      point.alive = label == kOutlier ? inImage(point.y) : step(point, label, k);
    }
    return point;
  }

  SyntheticOptions o_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

/// Deterministic in its options.
inline SyntheticWindow makeSyntheticWindow(const SyntheticOptions& options) {
  return SyntheticScene(options).make();
}

/// What a window over frames [first, last] sees of it.
inline SyntheticWindow slice(const SyntheticWindow& scene, FrameId first, FrameId last) {
  SyntheticWindow part{scene.camera, {first, last, {}}, {}, scene.T_ck_c0};
  for (std::size_t p = 0; p < scene.truth.size(); ++p) {
    Tracklet t{scene.window.tracklets[p].id, {}};
    for (const Observation& o : scene.window.tracklets[p].observations)
      if (o.frame >= first && o.frame <= last) t.observations.push_back(o);
    if (t.observations.empty()) continue;
    part.window.tracklets.push_back(std::move(t));
    part.truth.push_back(scene.truth[p]);
  }
  return part;
}

/// How well an assignment agrees with the truth.
struct Agreement {
  double share = 0;          ///< of the tracklets with three observations or more
  std::map<int, int> label;  ///< the one label given to each true one, outliers to kOutlier
};

/// Every true label is given at most one label, by their largest common supports.
inline Agreement agreement(const SyntheticWindow& scene, const std::vector<int>& assignment) {
  constexpr std::size_t kLeastObservations = 3;
  std::map<std::pair<int, int>, int> common;
  int total = 0;
  for (std::size_t p = 0; p < scene.truth.size(); ++p)
    if (scene.window.tracklets[p].observations.size() >= kLeastObservations) {
      ++common[{scene.truth[p], assignment[p]}];
      ++total;
    }
  std::vector<std::pair<int, std::pair<int, int>>> order;
  for (const auto& [pair, count] : common) order.push_back({count, pair});
  std::sort(order.rbegin(), order.rend());
  Agreement result;
  result.label[kOutlier] = kOutlier;
  std::set<int> given{kOutlier};
  int right = common[{kOutlier, kOutlier}];
  for (const auto& [count, pair] : order) {
    if (result.label.count(pair.first) > 0 || given.count(pair.second) > 0) continue;
    result.label[pair.first] = pair.second;
    given.insert(pair.second);
    right += count;
  }
  result.share = total == 0 ? 0 : static_cast<double>(right) / total;
  return result;
}

}  // namespace mvo::test
