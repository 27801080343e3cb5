// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The engine (III-A to III-F) on windows whose every motion is known.
#include "mvo/segment_motions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "kernels/link_residual.hpp"
#include "statistics.hpp"
#include "support/synthetic_window.hpp"

namespace mvo {
namespace {

using test::SyntheticOptions;
using test::SyntheticWindow;

Vector6d step(double x, double y, double z, double roll, double turn, double twist) {
  return (Vector6d() << x, y, z, roll, turn, twist).finished();
}

// Three bodies that a camera of this focal length sees move by one to three pixels a frame.
SyntheticOptions threeBodies(double focal_length, int width, int height) {
  SyntheticOptions o;
  o.camera = {focal_length, focal_length, 0.5 * width - 0.5, 0.5 * height - 0.5, 0.24,
              width,        height};
  const double s = 500 / focal_length;
  o.bodies = {{{-1.1, -0.5, 4.0}, 0.40, 40, s * step(0.015, 0.004, 0, 0, 0.01, 0)},
              {{1.0, -0.6, 4.5}, 0.45, 35, s * step(-0.004, 0.018, 0.004, 0, 0, 0.012)},
              {{0.1, 0.9, 4.0}, 0.40, 45, s * step(-0.012, -0.010, 0.008, 0.012, 0, 0)}};
  return o;
}

SyntheticOptions threeBodies() { return threeBodies(500, 640, 480); }

SyntheticOptions oneBody(const Vector6d& motion) {
  SyntheticOptions o;
  o.bodies = {{{-0.7, 0.2, 4}, 0.5, 40, motion}};
  return o;
}

Segmentation segment(const SyntheticWindow& scene, const Options& options = {}) {
  return segmentMotions(scene.window, scene.camera, {}, options);
}

// The label that most of a true label's tracklets have.
int majority(const SyntheticWindow& scene, const Segmentation& s, int label) {
  std::map<int, int> votes;
  for (const int p : scene.members(label))
    if (scene.window.tracklets[p].observations.size() >= 3) ++votes[s.labeling.assignment[p]];
  const auto most = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? kOutlier : most->first;
}

// Median of Eq. (1) per frame for a body's points under the static motion [px].
double apparentSpeed(const SyntheticWindow& scene, int label) {
  const LinkResidual distance(scene.camera, {}, ResidualModel::kImageDistance);
  std::vector<double> residuals;
  for (const int p : scene.members(label)) {
    const auto& o = scene.window.tracklets[p].observations;
    for (std::size_t j = 1; j < o.size(); ++j)
      if (o[j].frame - o[j - 1].frame == 1)
        residuals.push_back(
            distance(scene.between(0, o[j].frame, o[j - 1].frame), o[j - 1].y, o[j].y));
  }
  return median(std::move(residuals));
}

struct PoseError {
  double translation = 0;  ///< [m]
  double rotation = 0;     ///< [deg]
};

// The largest difference of two trajectories over their common frames, as seen from the first.
template <typename Other>
PoseError largestDifference(const Trajectory& a, FrameId first, FrameId last, const Other& other) {
  PoseError error;
  for (FrameId k = first; k <= last; ++k) {
    const auto T = a.between(k, first);
    if (!T) return {std::numeric_limits<double>::infinity(), 0};
    const Eigen::Isometry3d d = *T * other(k, first).inverse();
    error.translation = std::max(error.translation, d.translation().norm());
    error.rotation = std::max<double>(error.rotation, angle(d.linear()) * 180 / EIGEN_PI);
  }
  return error;
}

void expectAllMotionsFound(const SyntheticOptions& o) {
  const SyntheticWindow scene = makeSyntheticWindow(o);
  for (int l = 1; l <= 3; ++l) {
    const double speed = apparentSpeed(scene, l);
    EXPECT_GT(speed, 1) << "body " << l;
    EXPECT_LT(speed, 3) << "body " << l;
  }
  const Segmentation s = segment(scene);
  const test::Agreement a = test::agreement(scene, s.labeling.assignment);
  EXPECT_GE(a.share, 0.97);
  EXPECT_EQ(s.labeling.labels.size(), 4U);
  EXPECT_EQ(s.estimates.size(), s.labeling.labels.size());
  for (int l = 0; l <= 3; ++l) {
    ASSERT_TRUE(a.label.count(l)) << l;
    const auto& estimate = s.estimates[a.label.at(l)];
    ASSERT_TRUE(estimate) << l;
    EXPECT_EQ(estimate->trajectory.lastFrame(), scene.window.last_frame);
    const PoseError error = largestDifference(
        estimate->trajectory, estimate->trajectory.first_frame, scene.window.last_frame,
        [&](FrameId k, FrameId first) { return scene.between(l, k, first); });
    EXPECT_LT(error.translation, l == 0 ? 0.01 : 0.05) << l;
    EXPECT_LT(error.rotation, l == 0 ? 0.1 : 0.8) << l;
  }
}

TEST(SegmentMotions, FindsTheCameraAndThreeSlowBodiesAt640x480) {
  expectAllMotionsFound(threeBodies(500, 640, 480));
}

TEST(SegmentMotions, FindsTheCameraAndThreeSlowBodiesAt1280x960) {
  expectAllMotionsFound(threeBodies(1000, 1280, 960));
}

TEST(SegmentMotions, BothSolversAgree) {
  const SyntheticWindow scene = makeSyntheticWindow(threeBodies());
  Options coral;
  coral.engine.solver = Solver::kCoral;
  const Segmentation a = segment(scene);
  const Segmentation b = segment(scene, coral);
  EXPECT_GE(test::agreement(scene, b.labeling.assignment).share, 0.97);
  SyntheticWindow as_truth = scene;
  as_truth.truth = a.labeling.assignment;
  EXPECT_GE(test::agreement(as_truth, b.labeling.assignment).share, 0.98);
}

TEST(SegmentMotions, IsDeterministicWhateverTheNumberOfThreads) {
  const SyntheticWindow scene = makeSyntheticWindow(threeBodies());
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const Segmentation a = segment(scene);
  cv::setNumThreads(threads);
  const Segmentation b = segment(scene);
  EXPECT_EQ(a.labeling.assignment, b.labeling.assignment);
  ASSERT_EQ(a.estimates.size(), b.estimates.size());
  for (std::size_t l = 0; l < a.estimates.size(); ++l) {
    ASSERT_TRUE(a.estimates[l] && b.estimates[l]);
    EXPECT_EQ(a.estimates[l]->trajectory.T_ck_c1.back().matrix(),
              b.estimates[l]->trajectory.T_ck_c1.back().matrix());
  }
}

// The same window from the state one frame earlier and from nothing.
struct WarmAndCold {
  Segmentation warm;
  Segmentation cold;
  test::Agreement agreement;  ///< of the warm labels with the cold ones
};

WarmAndCold warmAndCold(const Options& options, const Deadline& deadline = {}) {
  SyntheticOptions o = threeBodies();
  o.frames = 25;
  const SyntheticWindow scene = makeSyntheticWindow(o);
  const SyntheticWindow before = slice(scene, 0, 23);
  SyntheticWindow now = slice(scene, 1, 24);

  const Segmentation last = segment(before, options);
  WarmStart start;
  start.typical_residual = last.typical_residual;
  std::map<TrackletId, int> label_of;
  for (std::size_t p = 0; p < before.truth.size(); ++p)
    label_of[before.window.tracklets[p].id] = last.labeling.assignment[p];
  for (const Tracklet& t : now.window.tracklets)
    start.assignment.push_back(label_of.count(t.id) > 0 ? label_of[t.id] : kOutlier);
  for (std::size_t l = 0; l < last.estimates.size(); ++l) {
    const auto& estimate = last.estimates[l];
    start.labels.push_back({static_cast<LabelId>(l),
                            estimate ? estimate->trajectory : last.labeling.labels[l].trajectory,
                            estimate ? estimate->landmarks : LandmarkMap{}});
  }
  WarmAndCold both{
      segmentMotions(now.window, now.camera, start, options, deadline), segment(now, options), {}};
  now.truth = both.cold.labeling.assignment;
  both.agreement = test::agreement(now, both.warm.labeling.assignment);
  return both;
}

TEST(SegmentMotions, WarmStartFindsTheLabelsOfAColdStart) {
  const WarmAndCold both = warmAndCold({});
  EXPECT_GE(both.agreement.share, 0.98);
  ASSERT_EQ(both.cold.estimates.size(), 4U);
  ASSERT_EQ(both.warm.estimates.size(), 4U);
  for (int l = 0; l < 4; ++l) {
    const int w = both.agreement.label.at(l);
    EXPECT_LT(both.warm.labeling.labels[w].id, 4) << "ids live on";
    // Few iterations leave less than the noise does.
    ASSERT_TRUE(both.cold.estimates[l] && both.warm.estimates[w]);
    const Trajectory& cold = both.cold.estimates[l]->trajectory;
    const Trajectory& warm = both.warm.estimates[w]->trajectory;
    ASSERT_EQ(cold.first_frame, warm.first_frame);
    const Vector6d d =
        log(*warm.between(24, warm.first_frame) * cold.between(24, cold.first_frame)->inverse());
    EXPECT_LT(std::sqrt(d.dot(both.cold.estimates[l]->summary.covariance.ldlt().solve(d)) / 6), 0.5)
        << l;
  }
}

TEST(SegmentMotions, WarmStartReachesTheMinimumOfAColdStart) {
  // A loss with one minimum, and iterations enough to reach it.
  Options patient;
  patient.bundle_adjustment.robust_scale = 2;
  patient.bundle_adjustment.warm_iterations = 30;
  patient.bundle_adjustment.max_iterations = 30;
  patient.bundle_adjustment.function_tolerance = 1e-6;
  const WarmAndCold both = warmAndCold(patient);
  ASSERT_EQ(both.cold.estimates.size(), 4U);
  for (int l = 0; l < 4; ++l) {
    const auto& c = both.cold.estimates[l];
    const auto& w = both.warm.estimates.at(both.agreement.label.at(l));
    ASSERT_TRUE(c && w);
    const FrameId first = std::max(c->trajectory.first_frame, w->trajectory.first_frame);
    const PoseError error =
        largestDifference(w->trajectory, first, 24,
                          [&](FrameId k, FrameId from) { return *c->trajectory.between(k, from); });
    EXPECT_LT(error.translation, 0.002) << l;
    EXPECT_LT(error.rotation, 0.05) << l;
  }
}

Deadline passedDeadline() {
  const Deadline deadline = Deadline::after(1e-3);
  while (!deadline.passed()) continue;
  return deadline;
}

TEST(SegmentMotions, WithoutTimeLeftEveryKnownMotionGoesOn) {
  const WarmAndCold both = warmAndCold({}, passedDeadline());
  EXPECT_TRUE(both.warm.cut_short.batch);
  EXPECT_FALSE(both.warm.converged);
  EXPECT_FALSE(both.cold.cut_short.any());
  EXPECT_EQ(both.warm.rounds, 1);
  EXPECT_GE(both.agreement.share, 0.97);
  ASSERT_EQ(both.warm.estimates.size(), 4U);
  for (int l = 0; l < 4; ++l) {
    const auto& warm = both.warm.estimates[both.agreement.label.at(l)];
    ASSERT_TRUE(warm && both.cold.estimates[l]);
    EXPECT_EQ(warm->summary.iterations, 0);
    EXPECT_FALSE(warm->summary.converged);
    EXPECT_GT(warm->summary.covariance.trace(), 0);
    ASSERT_EQ(warm->trajectory.lastFrame(), 24);
    // Only the newest step is a frame pair's.
    const PoseError error = largestDifference(
        warm->trajectory, warm->trajectory.first_frame, 24, [&](FrameId k, FrameId from) {
          return *both.cold.estimates[l]->trajectory.between(k, from);
        });
    EXPECT_LT(error.translation, l == 0 ? 0.01 : 0.05) << l;
    EXPECT_LT(error.rotation, l == 0 ? 0.1 : 1.0) << l;
  }
}

TEST(SegmentMotions, WithoutTimeLeftMotionsAreFoundAllTheSame) {
  const SyntheticWindow scene = makeSyntheticWindow(threeBodies());
  const Segmentation s = segmentMotions(scene.window, scene.camera, {}, {}, passedDeadline());
  EXPECT_EQ(s.rounds, 1);
  EXPECT_FALSE(s.converged);
  EXPECT_EQ(s.cut_short.text(), "refinement, rounds, batch");
  ASSERT_FALSE(s.estimates.empty());
  const int world = majority(scene, s, 0);
  ASSERT_NE(world, kOutlier);
  ASSERT_TRUE(s.estimates[world]);
  EXPECT_EQ(s.estimates[world]->trajectory.lastFrame(), scene.window.last_frame);
}

TEST(SegmentMotions, TimeEnoughIsNoLimit) {
  const SyntheticWindow scene = makeSyntheticWindow(threeBodies());
  const Segmentation free = segment(scene);
  const Segmentation timed =
      segmentMotions(scene.window, scene.camera, {}, {}, Deadline::after(1e6));
  EXPECT_FALSE(timed.cut_short.any());
  EXPECT_EQ(timed.converged, free.converged);
  EXPECT_EQ(timed.labeling.assignment, free.labeling.assignment);
}

TEST(SegmentMotions, ABodyThatStartsToMoveLateLeavesTheStaticLabel) {
  SyntheticOptions o = oneBody(step(0.02, 0.01, 0, 0, 0, 0));
  o.bodies[0].wakes = 18;
  o.min_length = o.frames;  // so that its points have long been static
  const SyntheticWindow scene = makeSyntheticWindow(o);
  const Segmentation s = segment(scene);
  const int world = majority(scene, s, 0);
  const int body = majority(scene, s, 1);
  EXPECT_NE(world, kOutlier);
  EXPECT_NE(body, kOutlier);
  EXPECT_NE(body, world);
  int followed = 0;
  for (const int p : scene.members(1)) {
    const Tracklet& t = scene.window.tracklets[p];
    if (t.last() < scene.window.last_frame || t.first() > 10) continue;
    ++followed;
    EXPECT_NE(s.labeling.assignment[p], world);
  }
  EXPECT_GE(followed, 20);
}

TEST(SegmentMotions, ABodyAtRestIsStatic) {
  const SyntheticWindow scene = makeSyntheticWindow(oneBody(Vector6d::Zero()));
  const Segmentation s = segment(scene);
  EXPECT_EQ(s.labeling.labels.size(), 1U);
  EXPECT_EQ(majority(scene, s, 1), majority(scene, s, 0));
}

TEST(SegmentMotions, ABodyTooSlowForConsecutiveFramesIsSeenOverLongerTimes) {
  const SyntheticWindow scene = makeSyntheticWindow(oneBody(step(0.003, 0.002, 0, 0, 0, 0)));
  EXPECT_LT(apparentSpeed(scene, 1), Options().energy.dead_zone);
  const Segmentation s = segment(scene);
  EXPECT_NE(majority(scene, s, 1), kOutlier);
  EXPECT_NE(majority(scene, s, 1), majority(scene, s, 0));
  EXPECT_GE(test::agreement(scene, s.labeling.assignment).share, 0.95);
}

TEST(SegmentMotions, EqualMotionsAreOneLabelOnlyIfTheyAreSeenTogether) {
  SyntheticOptions o;
  const Vector6d motion = step(0.02, 0.01, 0, 0, 0, 0);
  o.bodies = {{{-1.1, -0.4, 4}, 0.45, 40, motion}, {{0.7, -0.4, 4}, 0.45, 40, motion}};
  const SyntheticWindow together = makeSyntheticWindow(o);
  const Segmentation one = segment(together);
  EXPECT_EQ(majority(together, one, 1), majority(together, one, 2));
  EXPECT_NE(majority(together, one, 1), majority(together, one, 0));

  o.bodies[0].vanishes = 11;
  o.bodies[1].appears = 13;
  const SyntheticWindow apart = makeSyntheticWindow(o);
  const Segmentation two = segment(apart);
  EXPECT_NE(majority(apart, two, 1), majority(apart, two, 2));
  EXPECT_GE(test::agreement(apart, two.labeling.assignment).share, 0.97);
}

TEST(SegmentMotions, ThePaperProfileFindsFastBodies) {
  // Fast enough that no motion in between explains both within the wide threshold, and that a label
  // of its own pays.
  SyntheticOptions o = oneBody(step(0.15, 0.05, 0, 0, 0, 0.02));
  o.frames = 12;
  o.bodies[0].points = 60;
  o.bodies[0].center = {-1.5, -0.4, 4};
  const SyntheticWindow scene = makeSyntheticWindow(o);
  ASSERT_GT(apparentSpeed(scene, 1), 3 * optionsOfProfile("paper").energy.threshold);
  const Segmentation s = segment(scene, optionsOfProfile("paper"));
  EXPECT_NE(majority(scene, s, 1), kOutlier);
  EXPECT_NE(majority(scene, s, 1), majority(scene, s, 0));
  EXPECT_GE(test::agreement(scene, s.labeling.assignment).share, 0.9);
}

TEST(SegmentMotions, TakesAWindowOfAnotherSensor) {
  // A scanner with a field of view of 150 degrees and three-dimensional noise of 1 mm, which sees
  // every point in every second to third turn; its "camera" is a mere chart of the half space.
  const StereoCamera chart{300, 300, 0, 0, 1, 1, 1};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> noise(0, 0.001);
  SyntheticWindow scene{chart, {0, 15, {}}, {}, {{}, {}}};
  for (int k = 0; k <= 15; ++k) {
    const Eigen::Isometry3d T_ck_world = exp(k * step(0.02, 0, 0.1, 0, 0.01, 0)).inverse();
    const Eigen::Isometry3d T_world_body = exp(k * step(0.05, 0.02, 0, 0, 0, 0));
    scene.T_ck_c0[0].push_back(T_ck_world);
    scene.T_ck_c0[1].push_back(T_ck_world * T_world_body);
  }
  for (int p = 0; p < 160; ++p) {
    const int label = p % 4 == 0 ? 1 : 0;
    const Eigen::Vector3d p_c0 =
        label == 1
            ? Eigen::Vector3d(3 + uniform(random), uniform(random), 6 + uniform(random))
            : Eigen::Vector3d(16 * uniform(random), 4 * uniform(random), 7 + 3 * uniform(random));
    Tracklet t{p, {}};
    for (int k = 0; k <= 15; ++k) {
      if ((k + p) % 3 == 0) continue;
      const Eigen::Vector3d p_ck = scene.T_ck_c0[label][k] * p_c0 +
                                   Eigen::Vector3d(noise(random), noise(random), noise(random));
      t.observations.push_back({k, chart.project(p_ck)});
    }
    scene.window.tracklets.push_back(t);
    scene.truth.push_back(label);
  }
  const Segmentation s = segment(scene);
  const test::Agreement a = test::agreement(scene, s.labeling.assignment);
  EXPECT_GE(a.share, 0.97);
  ASSERT_TRUE(a.label.count(0));
  const auto& estimate = s.estimates.at(a.label.at(0));
  ASSERT_TRUE(estimate);
  const PoseError error =
      largestDifference(estimate->trajectory, estimate->trajectory.first_frame, 15,
                        [&](FrameId k, FrameId from) { return scene.between(0, k, from); });
  EXPECT_LT(error.translation, 0.01);
  EXPECT_LT(error.rotation, 0.1);
}

TEST(SegmentMotions, WindowsWithLittleOrNothingInThem) {
  const StereoCamera camera = SyntheticOptions().camera;
  const Segmentation nothing = segmentMotions({}, camera, {}, {});
  EXPECT_TRUE(nothing.labeling.labels.empty());
  EXPECT_TRUE(nothing.estimates.empty());
  const SyntheticWindow scene = makeSyntheticWindow(oneBody(Vector6d::Zero()));
  const SyntheticWindow instant = slice(scene, 4, 4);
  const Segmentation one_frame = segment(instant);
  EXPECT_EQ(one_frame.labeling.assignment.size(), instant.truth.size());
  for (const auto& estimate : one_frame.estimates) EXPECT_FALSE(estimate);
  for (const std::size_t n : {1U, 2U, 3U}) {
    Window few = scene.window;
    few.tracklets.resize(n);
    const Segmentation s = segmentMotions(few, camera, {}, {});
    EXPECT_EQ(s.labeling.assignment, std::vector<int>(n, kOutlier));
  }
}

TEST(SegmentMotions, OutliersAloneAreNoMotion) {
  SyntheticOptions o;
  o.static_points = 0;
  o.outliers = 80;
  const SyntheticWindow scene = makeSyntheticWindow(o);
  EXPECT_TRUE(segment(scene).labeling.labels.empty());
}

TEST(SequentialRansac, FindsTheDominantMotionsInTurn) {
  SyntheticOptions o = oneBody(step(0.05, 0.03, 0, 0, 0, 0.02));
  o.frames = 12;
  const SyntheticWindow scene = makeSyntheticWindow(o);
  const Segmentation s = sequentialRansac(scene.window, scene.camera, {});
  ASSERT_GE(s.labeling.labels.size(), 2U);
  EXPECT_EQ(s.estimates.size(), s.labeling.labels.size());
  EXPECT_EQ(majority(scene, s, 0), 0);
  EXPECT_EQ(majority(scene, s, 1), 1);
  EXPECT_GE(test::agreement(scene, s.labeling.assignment).share, 0.9);
  EXPECT_TRUE(sequentialRansac({}, scene.camera, {}).labeling.labels.empty());
}

}  // namespace
}  // namespace mvo
