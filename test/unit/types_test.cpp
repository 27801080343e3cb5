// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws of trajectories, and look-ups in tracklets and labellings.
#include "mvo/types.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace mvo {
namespace {

Eigen::Isometry3d randomStep(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::Vector3d axis(uniform(random), uniform(random), 1);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(0.2 * uniform(random), axis.normalized()).toRotationMatrix();
  T.translation() << uniform(random), uniform(random), uniform(random);
  return T;
}

// Frames 10 .. 16; the step to frame 14 is unknown.
struct Example {
  std::vector<Eigen::Isometry3d> steps;  // T_ck_ckm1 of the frames 11 .. 16
  Trajectory trajectory;

  Example() {
    std::mt19937 random(1);
    trajectory.first_frame = 10;
    trajectory.append(std::nullopt);
    for (FrameId frame = 11; frame <= 16; ++frame) {
      steps.push_back(randomStep(random));
      trajectory.append(frame == 14 ? std::nullopt : std::optional(steps.back()));
    }
  }
};

::testing::AssertionResult near(const std::optional<Eigen::Isometry3d>& a,
                                const Eigen::Isometry3d& b) {
  if (!a) return ::testing::AssertionFailure() << "no transform";
  const double error = (a->matrix() - b.matrix()).norm();
  if (error < 1e-12) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "off by " << error;
}

TEST(Trajectory, IsTheProductOfItsSteps) {
  const Example example;
  EXPECT_EQ(example.trajectory.lastFrame(), 16);
  EXPECT_TRUE(near(example.trajectory.between(11, 10), example.steps[0]));
  EXPECT_TRUE(near(example.trajectory.between(13, 10),
                   example.steps[2] * example.steps[1] * example.steps[0]));
  EXPECT_TRUE(near(example.trajectory.between(16, 14), example.steps[5] * example.steps[4]));
}

TEST(Trajectory, BetweenIsAGroupoid) {
  const Trajectory t = Example().trajectory;
  for (FrameId a = 10; a <= 16; ++a)
    for (FrameId b = 10; b <= 16; ++b) {
      const bool connected = (a < 14) == (b < 14);
      ASSERT_EQ(t.between(a, b).has_value(), connected) << a << " " << b;
      if (!connected) continue;
      EXPECT_TRUE(near(t.between(a, b), t.between(b, a)->inverse()));
      for (FrameId c = a < 14 ? 10 : 14; c <= (a < 14 ? 13 : 16); ++c)
        EXPECT_TRUE(near(t.between(a, c), *t.between(a, b) * *t.between(b, c)));
    }
  EXPECT_TRUE(near(t.between(12, 12), Eigen::Isometry3d::Identity()));
}

TEST(Trajectory, KnowsItsSpan) {
  Trajectory t = Example().trajectory;
  EXPECT_FALSE(t.has(9));
  EXPECT_TRUE(t.has(10));
  EXPECT_TRUE(t.has(16));
  EXPECT_FALSE(t.has(17));
  EXPECT_FALSE(t.between(9, 10));
  EXPECT_FALSE(t.between(16, 17));
  t.segment[3] = -1;  // no estimate at frame 13
  EXPECT_FALSE(t.has(13));
  EXPECT_FALSE(t.between(13, 13));
  EXPECT_TRUE(t.between(12, 10));
}

TEST(Trajectory, EmptyHasNothing) {
  const Trajectory t;
  EXPECT_TRUE(t.empty());
  EXPECT_FALSE(t.has(0));
  EXPECT_FALSE(t.between(0, 0));
}

TEST(Trajectory, StartsWithTheFirstAppended) {
  Trajectory t;
  std::mt19937 random(2);
  t.append(randomStep(random));  // into the first frame: nothing to compare it with
  EXPECT_FALSE(t.empty());
  EXPECT_TRUE(near(t.T_ck_c1[0], Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(t.has(0));
}

TEST(Trajectory, DroppingFramesKeepsTheRest) {
  const Trajectory whole = Example().trajectory;
  for (FrameId frame = 8; frame <= 16; ++frame) {
    Trajectory t = whole;
    t.dropBefore(frame);
    EXPECT_EQ(t.first_frame, std::max<FrameId>(frame, 10));
    EXPECT_EQ(t.lastFrame(), 16);
    EXPECT_EQ(t.segment.size(), t.T_ck_c1.size());
    EXPECT_TRUE(near(t.T_ck_c1.front(), Eigen::Isometry3d::Identity()));
    for (FrameId a = 9; a <= 17; ++a)
      for (FrameId b = 9; b <= 17; ++b) {
        const bool kept = a >= frame && b >= frame && whole.between(a, b).has_value();
        ASSERT_EQ(t.between(a, b).has_value(), kept) << frame << " " << a << " " << b;
        if (!kept) continue;
        EXPECT_TRUE(near(t.between(a, b), *whole.between(a, b)));
      }
  }
}

TEST(Trajectory, DroppingAllLeavesNothingButThePlace) {
  Trajectory t = Example().trajectory;
  t.dropBefore(20);
  EXPECT_TRUE(t.empty());
  EXPECT_EQ(t.first_frame, 20);
  t.append(std::nullopt);
  EXPECT_TRUE(t.has(20));
}

TEST(Trajectory, GoesOnAfterDropping) {
  Example example;
  example.trajectory.dropBefore(15);
  std::mt19937 random(3);
  const Eigen::Isometry3d step = randomStep(random);
  example.trajectory.append(step);
  EXPECT_TRUE(near(example.trajectory.between(17, 15), step * example.steps[5]));
}

TEST(Trajectory, StaysRigidHoweverOftenItIsCarriedOn) {
  std::mt19937 random(2);
  Trajectory trajectory;
  for (FrameId k = 0; k < 200; ++k) {
    trajectory.append(randomStep(random));
    trajectory.dropBefore(k - 5);
  }
  for (const Eigen::Isometry3d& T : trajectory.T_ck_c1)
    EXPECT_LT((T.linear().transpose() * T.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(Trajectory, AFrameIsExactlyWhereItIs) {
  const Example example;
  EXPECT_EQ(example.trajectory.between(12, 12)->matrix(), Eigen::Matrix4d::Identity());
}

TEST(Tracklet, FindsItsObservationsOverGaps) {
  Tracklet tracklet;
  for (const FrameId frame : {3, 4, 7})
    tracklet.observations.push_back({frame, Eigen::Vector3d(frame, 0, 0)});
  EXPECT_EQ(tracklet.first(), 3);
  EXPECT_EQ(tracklet.last(), 7);
  for (const FrameId frame : {3, 4, 7}) {
    ASSERT_NE(tracklet.find(frame), nullptr);
    EXPECT_EQ(tracklet.find(frame)->y.x(), static_cast<double>(frame));
  }
  for (const FrameId frame : {2, 5, 6, 8}) EXPECT_EQ(tracklet.find(frame), nullptr);
  EXPECT_EQ(Tracklet().find(0), nullptr);
}

TEST(Window, CountsItsFrames) {
  EXPECT_EQ(Window().frames(), 0);
  EXPECT_EQ((Window{5, 7, {}}.frames()), 3);
}

TEST(Labeling, SupportsAreAPartition) {
  Labeling labeling;
  labeling.labels.resize(3);
  labeling.assignment = {0, 1, kOutlier, 1, 0, kOutlier};
  EXPECT_EQ(labeling.support(0), (std::vector<int>{0, 4}));
  EXPECT_EQ(labeling.support(1), (std::vector<int>{1, 3}));
  EXPECT_TRUE(labeling.support(2).empty());
  EXPECT_EQ(labeling.support(kOutlier), (std::vector<int>{2, 5}));
}

}  // namespace
}  // namespace mvo
