// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F: which frames a label's batch spans, where it starts from, and that it improves on that.
#include "engine/estimation.hpp"

#include <gtest/gtest.h>

#include "support/synthetic_window.hpp"

namespace mvo {
namespace {

std::optional<LabelEstimate> estimateLabel(const Window& window, const StereoCamera& camera,
                                           const Trajectory& hypothesis,
                                           const std::vector<int>& support,
                                           const BatchStart& start) {
  Labeling labels;
  Label label;
  label.trajectory = hypothesis;
  labels.labels.push_back(label);
  labels.assignment.assign(window.tracklets.size(), kOutlier);
  for (const int p : support) labels.assignment[p] = 0;
  BatchMemory memory;
  return estimateLabels(window, camera, labels, {start}, {}, {}, memory).front();
}

test::SyntheticWindow world(int frames = 10) {
  test::SyntheticOptions o;
  o.frames = frames;
  o.static_points = 60;
  o.outliers = 0;
  return makeSyntheticWindow(o);
}

// A hypothesis that errs by about a centimetre and half a degree per frame.
Trajectory shaken(Trajectory t) {
  for (std::size_t k = 1; k < t.T_ck_c1.size(); ++k) {
    const double sign = k % 2 == 0 ? 1 : -1;
    t.T_ck_c1[k] = exp(sign * (Vector6d() << 0.01, -0.01, 0.01, 0.006, 0.006, -0.006).finished()) *
                   t.T_ck_c1[k];
  }
  return t;
}

double poseError(const Trajectory& t, const test::SyntheticWindow& scene, int label) {
  double worst = 0;
  for (FrameId k = t.first_frame; k <= t.lastFrame(); ++k)
    worst = std::max(
        worst, log(t.T_ck_c1[k - t.first_frame] * scene.between(label, k, t.first_frame).inverse())
                   .norm());
  return worst;
}

TEST(EstimateLabel, ImprovesAHypothesisToTheNoise) {
  const test::SyntheticWindow scene = world();
  const Trajectory hypothesis = shaken(scene.trajectory(0));
  ASSERT_GT(poseError(hypothesis, scene, 0), 0.01);
  const auto estimate =
      estimateLabel(scene.window, scene.camera, hypothesis, scene.members(0), {nullptr, 10});
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->trajectory.first_frame, 0);
  EXPECT_EQ(estimate->trajectory.lastFrame(), 9);
  EXPECT_TRUE(estimate->trajectory.between(9, 0));
  EXPECT_LT(poseError(estimate->trajectory, scene, 0), 0.004);
  EXPECT_TRUE(estimate->summary.usable);
  EXPECT_NEAR(estimate->summary.rms, 1, 0.3);
  EXPECT_EQ(estimate->landmarks.frame, 0);
}

TEST(EstimateLabel, SpansTheNewestConnectedRun) {
  const test::SyntheticWindow scene = world();
  Trajectory hypothesis = scene.trajectory(0);
  std::fill(hypothesis.segment.begin() + 4, hypothesis.segment.end(), 1);
  for (FrameId k = 4; k < 10; ++k) hypothesis.T_ck_c1[k] = scene.between(0, k, 4);
  const auto estimate =
      estimateLabel(scene.window, scene.camera, hypothesis, scene.members(0), {nullptr, 10});
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->trajectory.first_frame, 4);
  EXPECT_EQ(estimate->trajectory.lastFrame(), 9);
  EXPECT_LT(poseError(estimate->trajectory, scene, 0), 0.004);
}

TEST(EstimateLabel, EndsWhereItsSupportEnds) {
  const test::SyntheticWindow scene = world();
  test::SyntheticWindow left = slice(scene, 0, 6);
  left.window.last_frame = 9;
  const auto estimate =
      estimateLabel(left.window, left.camera, scene.trajectory(0), left.members(0), {nullptr, 10});
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->trajectory.first_frame, 0);
  EXPECT_EQ(estimate->trajectory.lastFrame(), 6);
  EXPECT_FALSE(estimate->trajectory.has(7));
}

TEST(EstimateLabel, StartsFromTheLastWindowsLandmarks) {
  const test::SyntheticWindow scene = world(11);
  const test::SyntheticWindow before = slice(scene, 0, 9);
  const test::SyntheticWindow now = slice(scene, 1, 10);
  const auto last = estimateLabel(before.window, before.camera, before.trajectory(0),
                                  before.members(0), {nullptr, 10});
  ASSERT_TRUE(last);
  Trajectory hypothesis = last->trajectory;
  hypothesis.append(scene.between(0, 10, 9));
  const auto warm =
      estimateLabel(now.window, now.camera, hypothesis, now.members(0), {&last->landmarks, 3});
  const auto cold =
      estimateLabel(now.window, now.camera, now.trajectory(0), now.members(0), {nullptr, 10});
  ASSERT_TRUE(warm && cold);
  EXPECT_EQ(warm->trajectory.first_frame, 1);
  EXPECT_LT(warm->summary.initial_cost, cold->summary.initial_cost);
  const Vector6d difference =
      log(*warm->trajectory.between(10, 1) * cold->trajectory.between(10, 1)->inverse());
  EXPECT_LT(difference.head<3>().norm(), 0.002);                  // [m]
  EXPECT_LT(difference.tail<3>().norm(), 0.05 * EIGEN_PI / 180);  // [rad]
}

TEST(EstimateLabel, NoneWithoutEnoughSupport) {
  const test::SyntheticWindow scene = world();
  const Trajectory truth = scene.trajectory(0);
  const auto estimate = [&](const Trajectory& hypothesis, const std::vector<int>& support) {
    return estimateLabel(scene.window, scene.camera, hypothesis, support, {nullptr, 10});
  };
  EXPECT_FALSE(estimate(truth, {}));
  EXPECT_FALSE(estimate(truth, {0, 1}));  // two points leave a rotation free
  EXPECT_FALSE(estimate(Trajectory{}, scene.members(0)));
  Trajectory single = truth;
  single.T_ck_c1.resize(1);
  single.segment.resize(1);
  EXPECT_FALSE(estimate(single, scene.members(0)));
  EXPECT_TRUE(estimate(truth, scene.members(0)));
}

}  // namespace
}  // namespace mvo
