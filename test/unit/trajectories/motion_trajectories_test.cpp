// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The camera's pose from frame to frame, whatever becomes of the labels.
#include "trajectories/motion_trajectories.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

namespace mvo {
namespace {

constexpr FrameId kSpan = 12;                // of the window [frames]
constexpr std::int64_t kPeriod = 100000000;  // [ns]
const StereoCamera kCamera{500, 500, 320, 240, 0.24, 640, 480};

Eigen::Isometry3d along(double x) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = x;
  return T;
}

// Points that one label holds.
struct Part {
  double depth = 5;                          // in the first frame [m]
  std::function<bool(int, int)> covers;      // of the image then
  std::function<double(FrameId)> camera_at;  // where the part sees the camera along x [m]
  FrameId from = 0;                          // frames in which the points are followed
  FrameId to = 1000;
  std::function<bool(FrameId)> is_labelled = [](FrameId) { return true; };
};

bool anywhere(int, int) { return true; }
bool onBlock(int u, int v) { return u > 220 && u < 420 && v > 140 && v < 340; }
double walking(FrameId k) { return 0.02 * static_cast<double>(k); }

class Trajectories : public testing::Test {
 protected:
  void addTracklets(int part, FrameId now, FrameId first, Window& window, Labeling& labeling) {
    const Part& p = parts_[part];
    TrackletId id = 10000 * part;
    for (int v = 20; v < kCamera.height; v += 40)
      for (int u = 20; u < kCamera.width; u += 40) {
        ++id;
        if (!p.covers(u, v)) continue;
        const Eigen::Vector3d point = kCamera.backProject(
            {static_cast<double>(u), static_cast<double>(v), kCamera.rightColumn(u, p.depth)});
        Tracklet t{id, {}};
        for (FrameId k = std::max(first, p.from); k <= std::min(now, p.to); ++k)
          t.observations.push_back(
              {k, kCamera.project(along(p.camera_at(0) - p.camera_at(k)) * point)});
        if (t.observations.size() < 2) continue;
        window.tracklets.push_back(t);
        labeling.assignment.push_back(p.is_labelled(now) ? part : kOutlier);
      }
  }
  // What the batch says of a part.
  std::optional<LabelEstimate> estimateOf(const Part& p, FrameId now, FrameId first) const {
    if (!p.is_labelled(now) || p.to < now || p.from >= now) return std::nullopt;
    LabelEstimate e;
    const FrameId begin = std::max(first, p.from);
    e.trajectory.first_frame = begin;
    for (FrameId k = begin; k <= now; ++k) {
      e.trajectory.T_ck_c1.push_back(along(p.camera_at(begin) - p.camera_at(k)));
      e.trajectory.segment.push_back(0);
    }
    e.summary.covariance = e.summary.step_covariance = 1e-8 * Matrix6d::Identity();
    return e;
  }
  MultimotionEstimate step(FrameId now) {
    Window window;
    window.first_frame = std::max<FrameId>(0, now - kSpan + 1);
    window.last_frame = now;
    Segmentation segmentation;
    segmentation.labeling.labels.resize(parts_.size());
    for (int part = 0; part < static_cast<int>(parts_.size()); ++part) {
      if (now > 0) addTracklets(part, now, window.first_frame, window, segmentation.labeling);
      segmentation.estimates.push_back(estimateOf(parts_[part], now, window.first_frame));
    }
    if (now == 0) {
      segmentation.labeling.labels.clear();
      segmentation.estimates.clear();
    }
    segmentation.labeling = trajectories_.identify(window, segmentation, kCamera, options_);
    std::vector<SeenTracklet> seen;
    for (std::size_t p = 0; p < window.tracklets.size(); ++p)
      if (window.tracklets[p].last() == now)
        seen.push_back({static_cast<int>(p), window.tracklets[p].observations.back().y});
    return trajectories_.add(window, segmentation, seen, 100, 1000 * kPeriod + now * kPeriod,
                             kCamera, options_);
  }
  static double x(const MultimotionEstimate& e) { return e.T_world_camera.translation().x(); }
  static std::map<FrameId, double> past(const MultimotionEstimate& e) {
    std::map<FrameId, double> poses;
    for (const SmoothedPose& pose : e.smoothed)
      if (pose.id == kStatic) poses[pose.frame] = pose.T_world_motion.translation().x();
    return poses;
  }

  Options options_;
  std::vector<Part> parts_;
  MotionTrajectories trajectories_;
};

TEST_F(Trajectories, FollowsTheWorldBesideABody) {
  parts_ = {{2, onBlock, [](FrameId k) { return -0.03 * static_cast<double>(k); }},
            {5, [](int u, int v) { return !onBlock(u, v); }, walking}};
  for (FrameId k = 0; k < 30; ++k) {
    const auto e = step(k);
    ASSERT_TRUE(e.valid) << e.problem;
    EXPECT_NEAR(x(e), walking(k), 1e-9);
    EXPECT_TRUE(e.notice.empty()) << e.notice;
  }
}

// The label that was the world holds a corner only; another surrounds it and says another speed.
TEST_F(Trajectories, AnotherWorldGoesOnFromTheLastPoseAndRewritesNone) {
  const auto faster = [](FrameId k) { return 0.05 * static_cast<double>(k); };
  parts_ = {{5, [](int u, int v) { return u < 200 && v < 160; }, walking},
            {5, [](int u, int v) { return u >= 200 || v >= 160; }, faster, 8}};
  int changes = 0;
  std::optional<MultimotionEstimate> before;
  for (FrameId k = 0; k < 60; ++k) {
    const auto e = step(k);
    ASSERT_TRUE(e.valid) << e.problem;
    if (before) {
      const bool changed = e.world_changes != before->world_changes;
      changes += changed ? 1 : 0;
      EXPECT_EQ(changed, !e.notice.empty()) << e.notice;
      EXPECT_NEAR(x(e) - x(*before), e.world_changes > 0 ? 0.05 : 0.02, 1e-9) << "frame " << k;
      const auto now = past(e);
      for (const auto& [frame, pose] : past(*before))
        if (now.count(frame) != 0) {
          EXPECT_NEAR(now.at(frame), pose, 1e-9) << k << ", " << frame;
        }
    }
    before = e;
  }
  EXPECT_EQ(changes, 1);
}

TEST_F(Trajectories, LostAndFoundWhereItIsIfTheWindowBridgesTheGap) {
  const auto gap = [](FrameId k) { return k >= 10 && k < 16; };
  const auto braking = [](FrameId k) { return walking(std::min<FrameId>(k, 12)); };
  parts_ = {{5, anywhere, braking}};
  parts_[0].is_labelled = [gap](FrameId k) { return !gap(k); };
  for (FrameId k = 0; k < 30; ++k) {
    const auto e = step(k);
    ASSERT_EQ(e.valid, !gap(k)) << k;
    if (gap(k)) {
      EXPECT_GT(e.problem.size(), 40U);
      EXPECT_TRUE(e.motions.empty());
      EXPECT_NEAR(x(e), walking(std::min<FrameId>(k, 14)), 1e-9) << "0.5 s on, then it stands";
    } else {
      EXPECT_NEAR(x(e), braking(k), 1e-9);
      EXPECT_EQ(!e.notice.empty(), k == 16) << e.notice;
    }
  }
}

TEST_F(Trajectories, LostAndFoundWhereItWasTakenToBeIfNothingBridgesTheGap) {
  parts_ = {{5, anywhere, walking, 0, 9}, {5, anywhere, walking, 20}};
  double held = 0;
  for (FrameId k = 0; k < 40; ++k) {
    const auto e = step(k);
    ASSERT_EQ(e.valid, k < 10 || k > 20) << k;
    if (!e.valid) held = x(e);
    if (k > 20) {
      EXPECT_NEAR(x(e), held + walking(k) - walking(20), 1e-9) << k;
    }
    EXPECT_EQ(!e.notice.empty(), k == 21) << e.notice;
  }
  EXPECT_NEAR(held, walking(14), 1e-9);
}

TEST_F(Trajectories, AStepThatCannotBeIsNotValid) {
  FrameId wrong = 15;
  parts_ = {{5, anywhere, [&wrong](FrameId k) { return walking(k) + (k == wrong ? 2 : 0); }}};
  for (FrameId k = 0; k < 25; ++k) {
    if (k == 16) wrong = -1;  // the batch knows better with another frame
    const auto e = step(k);
    ASSERT_EQ(e.valid, k != 15) << k;
    EXPECT_NEAR(x(e), walking(k), 1e-9);
    EXPECT_EQ(e.problem.find("the camera cannot have moved") == 0, k == 15) << e.problem;
  }
}

// All poses of the window at once are found to be elsewhere: no motion of the camera.
TEST_F(Trajectories, ACorrectionLargerThanAMotionIsNoJump) {
  bool corrected = false;
  parts_ = {
      {5, anywhere, [&corrected](FrameId k) { return walking(k) + (corrected && k > 8 ? 3 : 0); }}};
  for (FrameId k = 0; k < 20; ++k) {
    corrected = k >= 12;
    const auto e = step(k);
    ASSERT_TRUE(e.valid) << e.problem;
    EXPECT_NEAR(x(e), walking(k), 1e-9);
    EXPECT_EQ(!e.notice.empty(), k == 12) << e.notice;
    EXPECT_EQ(e.world_changes, 0);
  }
}

// It stays lost rather than to follow the body that is left.
TEST_F(Trajectories, TheBodyThatIsLeftIsNotFollowed) {
  parts_ = {{5, [](int u, int v) { return !onBlock(u, v); }, walking, 0, 10},
            {2, onBlock, [](FrameId k) { return -0.03 * static_cast<double>(k); }}};
  for (FrameId k = 0; k < 40; ++k) EXPECT_EQ(step(k).valid, k <= 10) << k;
}

}  // namespace
}  // namespace mvo
