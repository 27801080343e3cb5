// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/world_evidence.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace mvo {
namespace {

constexpr FrameId kLast = 10;
const StereoCamera kCamera{500, 500, 320, 240, 0.24, 640, 480};

Eigen::Isometry3d shift(double x) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = x;
  return T;
}

// Labels of points on a grid in the newest image, each at one depth and with one motion.
class Evidence : public testing::Test {
 protected:
  // Points `step` pixels apart where `covers(u, v)`; T_ck_c1 moves by `speed` along x [m/frame].
  int add(double depth, double speed, int step, const std::function<bool(int, int)>& covers) {
    const int l = static_cast<int>(segmentation_.labeling.labels.size());
    LabelEstimate estimate;
    for (FrameId k = 0; k <= kLast; ++k) {
      estimate.trajectory.T_ck_c1.push_back(shift(speed * static_cast<double>(k)));
      estimate.trajectory.segment.push_back(0);
    }
    for (int v = step / 2; v < kCamera.height; v += step)
      for (int u = step / 2; u < kCamera.width; u += step)
        if (covers(u, v)) addPoint(l, u, v, depth, speed);
    segmentation_.labeling.labels.push_back({l, estimate.trajectory});
    segmentation_.estimates.emplace_back(std::move(estimate));
    return l;
  }
  void addPoint(int label, int u, int v, double depth, double speed) {
    Tracklet t;
    t.id = static_cast<TrackletId>(window_.tracklets.size());
    const Eigen::Vector3d now =
        kCamera.backProject({double(u), double(v), kCamera.rightColumn(u, depth)});
    for (FrameId k = 0; k <= kLast; ++k)
      t.observations.push_back({k, kCamera.project(shift(speed * double(k - kLast)) * now)});
    window_.tracklets.push_back(t);
    segmentation_.labeling.assignment.push_back(label);
  }
  std::vector<WorldEvidence> evidence() {
    window_.last_frame = kLast;
    return worldEvidence(window_, segmentation_, kCamera, NoiseOptions());
  }

  Window window_;
  Segmentation segmentation_;
};

bool nearBlock(int u, int v) { return u > 180 && u < 460 && v > 100 && v < 380; }

TEST_F(Evidence, TheWorldReachesAroundAndLiesBehind) {
  add(5, 0.01, 20, [](int u, int v) { return !nearBlock(u, v); });
  add(2, -0.01, 20, nearBlock);
  const auto e = evidence();
  ASSERT_EQ(e.size(), 2U);
  EXPECT_GT(e[0].around, 0.6);
  EXPECT_LT(e[1].around, 0.5);
  EXPECT_GT(e[0].behind, 0.1);
  EXPECT_LT(e[1].behind, -0.1);
  EXPECT_GT(e[0].value(), e[1].value() + 0.5);
  EXPECT_TRUE(e[0].alive && e[1].alive);
  EXPECT_FALSE(e[0].rides || e[1].rides);
  EXPECT_EQ(e[0].seen + e[1].seen, static_cast<int>(window_.tracklets.size()));
}

TEST_F(Evidence, ABodyThatFillsTwoThirdsOfTheViewLooksLessLikeTheWorld) {
  add(6, 0.01, 20, [](int u, int) { return u < 210; });
  add(1.5, -0.01, 20, [](int u, int) { return u >= 210; });
  const auto e = evidence();
  EXPECT_GT(e[1].around, 0.6);
  EXPECT_LT(e[1].value(), e[0].value() + 0.3) << "the margin that a challenger needs";
}

TEST_F(Evidence, EqualDepthsSayNothing) {
  add(3, 0.01, 20, [](int u, int) { return u < 320; });
  add(3.05, -0.01, 20, [](int u, int) { return u >= 320; });
  const auto e = evidence();
  EXPECT_EQ(e[0].behind, 0);
  EXPECT_EQ(e[1].behind, 0);
}

TEST_F(Evidence, AHoodRidesWithTheCamera) {
  add(8, 0.05, 20, [](int, int v) { return v < 400; });
  add(0.8, 0, 10, [](int, int v) { return v >= 400; });
  const auto e = evidence();
  EXPECT_FALSE(e[0].rides);
  EXPECT_TRUE(e[1].rides);
  EXPECT_EQ(e[1].value(), -1);
}

// A camera at rest: what rests with it and lies behind a passing body is the world.
TEST_F(Evidence, AWorldAtRestDoesNotRide) {
  add(8, 0, 20, [](int u, int v) { return !nearBlock(u, v); });
  add(3, 0.05, 20, nearBlock);
  const auto e = evidence();
  EXPECT_FALSE(e[0].rides);
  EXPECT_FALSE(e[1].rides);
  EXPECT_GT(e[0].value(), e[1].value());
}

TEST_F(Evidence, FarPointsDoNotRide) {  // that the camera's translation cannot move
  add(8, 0.02, 20, [](int u, int v) { return v > 60 && !nearBlock(u, v); });
  add(2000, 0, 20, [](int, int v) { return v <= 60; });
  EXPECT_FALSE(evidence()[1].rides);
}

TEST_F(Evidence, NothingFromNothing) {
  EXPECT_TRUE(evidence().empty());
  add(3, 0, 20, [](int, int) { return false; });
  const auto e = evidence();
  EXPECT_EQ(e[0].seen, 0);
  EXPECT_EQ(e[0].value(), 0);
}

}  // namespace
}  // namespace mvo
