// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F: exact recovery, consistency with its own covariance, outliers, far and flat scenes, and
// what must be refused.
#include "engine/batch/bundle_adjustment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <tuple>

#include "mvo/se3.hpp"
#include "support/bundle_scene.hpp"

namespace mvo {
namespace {

using test::adjustBundle;
using test::Batch;
using test::BundleScene;
using test::makeBundleScene;
using test::SceneOptions;

BundleAdjustmentOptions exactly() {
  BundleAdjustmentOptions options;
  options.min_observations = 3;  // the least that can
  options.robust_scale = 2;      // wide enough for one minimum
  options.function_tolerance = 0;
  return options;
}

BundleAdjustmentOptions squares() {
  BundleAdjustmentOptions options = exactly();
  options.robust_scale = 0;
  return options;
}

// Largest difference of two batches' poses, as twists [m, rad].
double poseDifference(const std::vector<Eigen::Isometry3d>& a,
                      const std::vector<Eigen::Isometry3d>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, log(a[k] * b[k].inverse()).norm());
  return largest;
}

bool sameBytes(const Batch& a, const Batch& b) {
  bool same = a.T_ck_c1.size() == b.T_ck_c1.size() && a.landmarks.size() == b.landmarks.size();
  for (std::size_t k = 0; same && k < a.T_ck_c1.size(); ++k)
    same = a.T_ck_c1[k].matrix() == b.T_ck_c1[k].matrix();
  for (std::size_t j = 0; same && j < a.landmarks.size(); ++j)
    same = a.landmarks[j].p_c1 == b.landmarks[j].p_c1;
  return same;
}

constexpr std::array<BatchBackend, 2> kBackends = {BatchBackend::kCeres, BatchBackend::kSchur};

class EachBatch : public ::testing::TestWithParam<std::tuple<BatchBackend, DampingMethod>> {
 protected:
  BatchSummary adjust(const BundleScene& scene, Batch& batch,
                      BundleAdjustmentOptions options) const {
    std::tie(options.backend, options.damping) = GetParam();
    return adjustBundle(batch, scene.camera, scene.noise, options, 50);
  }
};

TEST_P(EachBatch, NoiselessSceneIsRecoveredExactly) {
  SceneOptions with;
  with.noise_scale = 0;
  const BundleScene scene = makeBundleScene(with);
  Batch batch = scene.start;
  ASSERT_GT(poseDifference(batch.T_ck_c1, scene.truth.T_ck_c1), 1e-2);
  const BatchSummary summary = adjust(scene, batch, exactly());
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(poseDifference(batch.T_ck_c1, scene.truth.T_ck_c1), 1e-9);
  EXPECT_LT(summary.rms, 1e-8);
  for (std::size_t j = 0; j < batch.landmarks.size(); ++j)
    EXPECT_LT((batch.landmarks[j].p_c1.hnormalized() - scene.truth.landmarks[j].p_c1.hnormalized())
                  .norm(),
              1e-7);
  EXPECT_TRUE(batch.T_ck_c1.front().matrix() == Eigen::Matrix4d::Identity());
}

TEST_P(EachBatch, NoiseIsWhatTheModelSays) {
  const BundleScene scene = makeBundleScene({});
  Batch batch = scene.start;
  const BatchSummary summary = adjust(scene, batch, squares());
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_GT(summary.rms, 0.85);  // below 1: the estimate follows the noise
  EXPECT_LT(summary.rms, 1.0);
  EXPECT_LT(poseDifference(batch.T_ck_c1, scene.truth.T_ck_c1), 0.02);
}

INSTANTIATE_TEST_SUITE_P(BundleAdjustment, EachBatch,
                         ::testing::Combine(::testing::ValuesIn(kBackends),
                                            ::testing::Values(DampingMethod::kLevenbergMarquardt,
                                                              DampingMethod::kGaussNewton)));

TEST(BundleAdjustment, BackendsAndDampingReachTheSameMinimum) {
  SceneOptions with;
  with.points = 150;
  with.far_points = 30;
  with.frames = 16;
  with.outliers = 0.02;
  const BundleScene scene = makeBundleScene(with);
  for (BundleAdjustmentOptions options : {exactly(), squares()}) {
    Batch reference = scene.start;
    const auto expected = adjustBundle(reference, scene.camera, scene.noise, options, 100);
    ASSERT_TRUE(expected.usable);
    for (const auto damping : {DampingMethod::kLevenbergMarquardt, DampingMethod::kGaussNewton})
      for (const auto backend : kBackends) {
        options.damping = damping;
        options.backend = backend;
        Batch batch = scene.start;
        const auto summary = adjustBundle(batch, scene.camera, scene.noise, options, 100);
        ASSERT_TRUE(summary.usable);
        EXPECT_NEAR(summary.final_cost, expected.final_cost, 1e-8 * expected.final_cost);
        EXPECT_LT(poseDifference(batch.T_ck_c1, reference.T_ck_c1), 1e-6);
        EXPECT_LT((summary.covariance - expected.covariance).norm(),
                  1e-3 * expected.covariance.norm());
      }
  }
}

// Step for step, not only in the end.
TEST(BundleAdjustment, BackendsTakeTheSameSteps) {
  const BundleScene scene = makeBundleScene({});
  BundleAdjustmentOptions options = exactly();
  for (const int iterations : {1, 2, 3}) {
    Batch a = scene.start;
    Batch b = scene.start;
    options.backend = BatchBackend::kCeres;
    adjustBundle(a, scene.camera, scene.noise, options, iterations);
    options.backend = BatchBackend::kSchur;
    adjustBundle(b, scene.camera, scene.noise, options, iterations);
    EXPECT_LT(poseDifference(a.T_ck_c1, b.T_ck_c1), 1e-9) << iterations;
  }
}

// The cost is J of the paper, with R_jk of a disparity that is independent of u_l.
TEST(BundleAdjustment, CostIsTheWhitenedSquare) {
  SceneOptions with;
  with.noise_scale = 0;
  const BundleScene scene = makeBundleScene(with);
  const auto initialCost = [&](const Eigen::Vector3d& error, double robust_scale) {
    Batch batch = scene.truth;
    batch.landmarks[3].observations[2].y += error;
    BundleAdjustmentOptions options;
    options.robust_scale = robust_scale;
    return adjustBundle(batch, scene.camera, scene.noise, options, 1).initial_cost;
  };
  const double left = scene.noise.left;
  const double disparity = scene.noise.disparity;
  EXPECT_NEAR(initialCost({0, 2 * left, 0}, 0), 0.5 * 4, 1e-9);
  EXPECT_NEAR(initialCost({0, 0, 3 * disparity}, 0), 0.5 * 9, 1e-9);
  EXPECT_NEAR(initialCost({left, 0, left}, 0), 0.5, 1e-9);  // disparity unchanged
  EXPECT_NEAR(initialCost({left, 0, 0}, 0), 0.5 * (1 + std::pow(left / disparity, 2)), 1e-9);
  EXPECT_NEAR(initialCost({0, 4 * left, 0}, 2), 0.5 * 4 * std::log(1 + 16.0 / 4), 1e-9);
}

TEST(BundleAdjustment, ErrorsAreWhatTheCovarianceSays) {
  const std::vector<std::pair<double, double>> cases = {{0.0, 1.0}, {2.0, 1.0}, {0.5, 1.0},
                                                        {0.0, 3.0}, {0.5, 3.0}, {0.5, 0.7}};
  for (const auto& [robust_scale, noise_scale] : cases) {
    SCOPED_TRACE("noise " + std::to_string(noise_scale));
    constexpr int kProblems = 60;
    double sum = 0;
    double step_sum = 0;
    for (int i = 0; i < kProblems; ++i) {
      SceneOptions with;
      with.frames = 6;
      with.points = 25;
      with.seed = 100 + static_cast<unsigned>(i);
      with.noise_scale = noise_scale;
      const BundleScene scene = makeBundleScene(with);
      Batch batch = scene.start;
      BundleAdjustmentOptions options = exactly();
      options.robust_scale = robust_scale;
      options.backend = BatchBackend::kSchur;
      const auto summary = adjustBundle(batch, scene.camera, scene.noise, options, 20);
      ASSERT_TRUE(summary.usable);
      EXPECT_NEAR(summary.noise / noise_scale, 1, 0.35);
      const Vector6d error = log(batch.T_ck_c1.back() * scene.truth.T_ck_c1.back().inverse());
      sum += error.dot(summary.covariance.llt().solve(error));
      const auto newestStep = [](const Batch& b) {
        return Eigen::Isometry3d(b.T_ck_c1.back() * b.T_ck_c1[b.T_ck_c1.size() - 2].inverse());
      };
      const Vector6d step_error = log(newestStep(batch) * newestStep(scene.truth).inverse());
      step_sum += step_error.dot(summary.step_covariance.llt().solve(step_error));
    }
    // chi^2 of 6 degrees: the mean of 60 has standard deviation sqrt(12 / 60) = 0.45.
    EXPECT_GT(sum / kProblems, 6 - 3 * 0.45) << robust_scale;
    EXPECT_LT(sum / kProblems, 6 + 3 * 0.45) << robust_scale;
    EXPECT_GT(step_sum / kProblems, 6 - 3 * 0.45) << robust_scale;
    EXPECT_LT(step_sum / kProblems, 6 + 3 * 0.45) << robust_scale;
  }
}

TEST(BundleAdjustment, GrossOutliersStayWithinTheNoise) {
  SceneOptions with;
  with.points = 120;
  const BundleScene clean = makeBundleScene(with);
  with.outliers = 0.05;
  const BundleScene spoilt = makeBundleScene(with);
  Batch a = clean.start;
  Batch b = spoilt.start;
  Batch c = spoilt.start;
  const auto without = adjustBundle(a, clean.camera, clean.noise, exactly(), 50);
  const auto robust = adjustBundle(b, spoilt.camera, spoilt.noise, exactly(), 50);
  const auto plain = adjustBundle(c, spoilt.camera, spoilt.noise, squares(), 50);
  ASSERT_TRUE(without.usable && robust.usable);
  const Vector6d moved = log(b.T_ck_c1.back() * a.T_ck_c1.back().inverse());
  EXPECT_LT(std::sqrt(moved.dot(without.covariance.llt().solve(moved)) / 6), 1.0);
  if (plain.usable) {  // the outliers are gross: squares do move
    EXPECT_GT(poseDifference(c.T_ck_c1, a.T_ck_c1), 5 * poseDifference(b.T_ck_c1, a.T_ck_c1));
  }
}

TEST(BundleAdjustment, FarPointsHoldTheRotation) {
  SceneOptions with;
  with.points = 30;
  with.far_points = 60;  // disparity 0 to 0.5 px: many are measured as negative
  const BundleScene scene = makeBundleScene(with);
  const auto isNegative = [](const Observation& o) { return o.y.x() < o.y.z(); };
  int negative = 0;
  for (const auto& landmark : scene.start.landmarks)
    negative += static_cast<int>(
        std::count_if(landmark.observations.begin(), landmark.observations.end(), isNegative));
  ASSERT_GT(negative, 20);

  with.far_points = 0;
  const BundleScene near = makeBundleScene(with);
  Batch all = scene.start;
  Batch few = near.start;
  const auto with_far = adjustBundle(all, scene.camera, scene.noise, exactly(), 50);
  const auto without = adjustBundle(few, near.camera, near.noise, exactly(), 50);
  ASSERT_TRUE(with_far.usable && without.usable);
  EXPECT_LT(with_far.rms, 1.0);
  EXPECT_LT(with_far.covariance.diagonal().tail<3>().sum(),
            0.5 * without.covariance.diagonal().tail<3>().sum());
  const Vector6d error = log(all.T_ck_c1.back() * scene.truth.T_ck_c1.back().inverse());
  EXPECT_LT(error.dot(with_far.covariance.llt().solve(error)), 22.5);  // 99.9 % of chi^2, 6 degrees
}

TEST(BundleAdjustment, FlatScenesShowTheWeakDirectionOnly) {
  SceneOptions with;
  with.flat = true;
  const BundleScene scene = makeBundleScene(with);
  Batch batch = scene.start;
  const auto summary = adjustBundle(batch, scene.camera, scene.noise, exactly(), 50);
  ASSERT_TRUE(summary.usable);
  const Vector6d error = log(batch.T_ck_c1.back() * scene.truth.T_ck_c1.back().inverse());
  EXPECT_LT(error.dot(summary.covariance.llt().solve(error)), 22.5);
  // Turning about x or y looks like moving along y or x; turning about z like nothing else.
  EXPECT_GT(summary.covariance(3, 3), 4 * summary.covariance(5, 5));
  EXPECT_GT(summary.covariance(4, 4), 4 * summary.covariance(5, 5));
}

TEST(BundleAdjustment, PointsMayPassBehindTheFirstCamera) {
  SceneOptions with;
  with.turn = 2.5;  // over the batch: the last points lie behind C_1
  with.max_length = 5;
  with.points = 300;
  const BundleScene scene = makeBundleScene(with);
  const auto isBehind = [](const Batch::Landmark& l) { return l.p_c1.hnormalized().z() < 0; };
  ASSERT_TRUE(std::any_of(scene.truth.landmarks.begin(), scene.truth.landmarks.end(), isBehind));
  Batch batch = scene.start;
  const auto summary = adjustBundle(batch, scene.camera, scene.noise, squares(), 50);
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(summary.rms, 1.0);
  EXPECT_LT(poseDifference(batch.T_ck_c1, scene.truth.T_ck_c1), 0.1);
}

TEST(BundleAdjustment, LandmarksWithoutAStartStartFromTheirMeasurement) {
  const BundleScene scene = makeBundleScene({});
  Batch given = scene.start;
  Batch none = scene.start;
  Batch behind = scene.start;
  for (auto& landmark : none.landmarks) landmark.p_c1.setZero();
  for (auto& landmark : behind.landmarks) landmark.p_c1.head<3>() *= -1;
  for (Batch* batch : {&given, &none, &behind}) {
    const auto summary = adjustBundle(*batch, scene.camera, scene.noise, exactly(), 50);
    ASSERT_TRUE(summary.usable);
    EXPECT_LT(poseDifference(batch->T_ck_c1, given.T_ck_c1), 1e-6);
  }
}

TEST(BundleAdjustment, ResultsDoNotDependOnThreads) {
  SceneOptions with;
  with.frames = 20;
  with.points = 1000;  // enough to be split
  with.max_length = 12;
  const BundleScene scene = makeBundleScene(with);
  const int usual = cv::getNumThreads();
  for (const auto backend : kBackends) {
    BundleAdjustmentOptions options;
    options.backend = backend;
    cv::setNumThreads(1);
    Batch one = scene.start;
    const auto expected = adjustBundle(one, scene.camera, scene.noise, options, 10);
    ASSERT_TRUE(expected.usable);
    for (const int threads : {1, 2, 3}) {
      cv::setNumThreads(threads);
      Batch batch = scene.start;
      const auto summary = adjustBundle(batch, scene.camera, scene.noise, options, 10);
      EXPECT_TRUE(sameBytes(batch, one));
      EXPECT_TRUE(summary.covariance == expected.covariance);
      EXPECT_EQ(summary.final_cost, expected.final_cost);
    }
  }
  cv::setNumThreads(usual);
}

TEST(BundleAdjustment, IterationsBoundTheSteps) {
  const BundleScene scene = makeBundleScene({});
  for (const auto backend : kBackends) {
    Batch batch = scene.start;
    BundleAdjustmentOptions options = exactly();
    options.backend = backend;
    const auto one = adjustBundle(batch, scene.camera, scene.noise, options, 1);
    ASSERT_TRUE(one.usable);
    EXPECT_EQ(one.iterations, 1);
    EXPECT_FALSE(one.converged);
    options.function_tolerance = BundleAdjustmentOptions().function_tolerance;
    const auto rest = adjustBundle(batch, scene.camera, scene.noise, options, 30);
    EXPECT_TRUE(rest.converged);
    EXPECT_LT(rest.iterations, 10);
    const auto warm = adjustBundle(batch, scene.camera, scene.noise, options, 30);
    EXPECT_TRUE(warm.converged);
    EXPECT_EQ(warm.iterations, 1);
  }
}

// Whatever is refused leaves the batch as it was.
void expectRefused(const BundleScene& scene, const Batch& start, const char* why) {
  for (int way = 0; way < 4; ++way) {
    Batch batch = start;
    BundleAdjustmentOptions options;
    options.backend = static_cast<BatchBackend>(way / 2);
    options.damping = static_cast<DampingMethod>(way % 2);
    const auto summary = adjustBundle(batch, scene.camera, scene.noise, options, 10);
    EXPECT_FALSE(summary.usable) << why;
    EXPECT_EQ(summary.covariance, Matrix6d::Zero()) << why;
    for (std::size_t k = 0; k < start.T_ck_c1.size(); ++k)
      EXPECT_EQ(std::memcmp(&batch.T_ck_c1[k], &start.T_ck_c1[k], sizeof(Eigen::Isometry3d)), 0)
          << why;
    for (std::size_t j = 0; j < start.landmarks.size(); ++j)
      EXPECT_EQ(
          std::memcmp(&batch.landmarks[j].p_c1, &start.landmarks[j].p_c1, sizeof(Eigen::Vector4d)),
          0)
          << why;
  }
}

TEST(BundleAdjustment, RefusesTooLittle) {
  const BundleScene scene = makeBundleScene({});
  Batch batch = scene.start;
  batch.landmarks.clear();
  expectRefused(scene, batch, "no landmarks");
  expectRefused(scene, Batch{}, "nothing at all");
  batch.landmarks.assign(scene.start.landmarks.begin(), scene.start.landmarks.begin() + 2);
  expectRefused(scene, batch, "two landmarks");

  batch = scene.start;
  for (auto& landmark : batch.landmarks) landmark.observations.clear();
  expectRefused(scene, batch, "no observations");

  SceneOptions one_frame;
  one_frame.frames = 1;
  const BundleScene still = makeBundleScene(one_frame);
  expectRefused(still, still.start, "one frame");

  batch = scene.start;
  int left = 2;
  for (auto& landmark : batch.landmarks) {
    const auto isThird = [&](const Observation& o) {
      return o.frame == batch.first_frame + 3 && left-- <= 0;
    };
    auto& of = landmark.observations;
    of.erase(std::remove_if(of.begin(), of.end(), isThird), of.end());
  }
  expectRefused(scene, batch, "a pose with two observations");
}

// Points that one pose alone sees say nothing about it.
TEST(BundleAdjustment, PointsSeenOnceDoNotHelp) {
  const BundleScene scene = makeBundleScene({});
  Batch batch = scene.start;
  for (const auto& landmark : scene.start.landmarks) {
    Batch::Landmark once = landmark;
    once.observations.resize(1);
    batch.landmarks.push_back(once);
  }
  Batch alone = scene.start;
  const auto expected = adjustBundle(alone, scene.camera, scene.noise, squares(), 30);
  const auto summary = adjustBundle(batch, scene.camera, scene.noise, squares(), 30);
  ASSERT_TRUE(expected.usable && summary.usable);
  EXPECT_LT(poseDifference(batch.T_ck_c1, alone.T_ck_c1), 1e-7);
  EXPECT_LT((summary.covariance - expected.covariance).norm(), 1e-6 * expected.covariance.norm());

  for (auto& landmark : batch.landmarks) landmark.observations.resize(1);
  expectRefused(scene, batch, "all seen once");
}

TEST(BundleAdjustment, ThreeTrackletsSuffice) {
  SceneOptions with;
  with.points = 3;
  with.min_length = with.max_length = with.frames;
  const BundleScene scene = makeBundleScene(with);
  Batch batch = scene.start;
  EXPECT_TRUE(adjustBundle(batch, scene.camera, scene.noise, exactly(), 50).usable);
}

TEST(BundleAdjustment, RefusesWhatIsNotFiniteOrInOrder) {
  const BundleScene scene = makeBundleScene({});
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Batch batch = scene.start;
    batch.landmarks[1].observations[0].y.z() = bad;
    expectRefused(scene, batch, "observation");
    batch = scene.start;
    batch.landmarks[1].p_c1.x() = bad;
    expectRefused(scene, batch, "landmark");
    batch = scene.start;
    batch.T_ck_c1[2].translation().y() = bad;
    expectRefused(scene, batch, "pose");
  }
  Batch batch = scene.start;
  batch.T_ck_c1[2].linear() *= 1.1;
  expectRefused(scene, batch, "not a rotation");
  batch = scene.start;
  batch.landmarks[1].observations.back().frame = batch.first_frame - 1;
  expectRefused(scene, batch, "a frame outside the span");
  batch = scene.start;
  std::swap(batch.landmarks[1].observations[0], batch.landmarks[1].observations[1]);
  expectRefused(scene, batch, "observations out of order");
  batch = scene.start;
  batch.landmarks[1].observations[1].frame = batch.landmarks[1].observations[0].frame;
  expectRefused(scene, batch, "two observations in a frame");
  BundleScene blind = scene;
  blind.camera.baseline = 0;
  expectRefused(blind, blind.start, "no baseline");
}

TEST(BundleAdjustment, RefusesPointsOnALine) {
  for (const double noise_scale : {0.0, 1.0}) {
    SceneOptions with;
    with.noise_scale = noise_scale;
    with.collinear = true;
    const BundleScene scene = makeBundleScene(with);
    expectRefused(scene, scene.start, "collinear");
  }
  // In one frame only.
  SceneOptions with;
  with.noise_scale = 0;
  with.collinear = true;
  const BundleScene line = makeBundleScene(with);
  with.collinear = false;
  BundleScene mixed = makeBundleScene(with);
  const FrameId frame = mixed.start.first_frame + 4;
  const auto isElsewhere = [&](const Observation& o) { return o.frame != frame; };
  for (auto& landmark : mixed.start.landmarks) {
    auto& of = landmark.observations;
    of.erase(
        std::remove_if(of.begin(), of.end(), [&](const Observation& o) { return !isElsewhere(o); }),
        of.end());
  }
  mixed.start.landmarks.insert(mixed.start.landmarks.end(), line.start.landmarks.begin(),
                               line.start.landmarks.end());
  expectRefused(mixed, mixed.start, "collinear in one frame");
}

TEST(BundleAdjustment, RefusesHolesInTime) {
  SceneOptions with;
  with.min_length = with.max_length = with.frames;
  const BundleScene scene = makeBundleScene(with);
  const FrameId middle = scene.start.first_frame + with.frames / 2;
  // Landmarks see either the first half or the second; the first `bridges` see both.
  const auto cut = [&](std::size_t bridges) {
    Batch batch = scene.start;
    for (std::size_t j = bridges; j < batch.landmarks.size(); ++j) {
      auto& of = batch.landmarks[j].observations;
      const auto isOther = [&](const Observation& o) { return (o.frame < middle) == (j % 2 == 0); };
      of.erase(std::remove_if(of.begin(), of.end(), isOther), of.end());
    }
    return batch;
  };
  expectRefused(scene, cut(0), "no bridge");
  expectRefused(scene, cut(1), "a bridge of one");
  expectRefused(scene, cut(2), "a bridge of two");
  Batch bridged = cut(6);
  EXPECT_TRUE(adjustBundle(bridged, scene.camera, scene.noise, exactly(), 50).usable);
}

TEST(BundleAdjustment, HopelessStartsStayFinite) {
  const BundleScene scene = makeBundleScene({});
  Batch batch = scene.start;
  // The cameras look the other way: every point is behind every camera.
  for (std::size_t k = 1; k < batch.T_ck_c1.size(); ++k)
    batch.T_ck_c1[k] = Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitY()) * batch.T_ck_c1[k];
  const Batch start = batch;
  for (const auto backend : kBackends) {
    batch = start;
    BundleAdjustmentOptions options = exactly();
    options.backend = backend;
    const auto summary = adjustBundle(batch, scene.camera, scene.noise, options, 30);
    EXPECT_TRUE(std::isfinite(summary.initial_cost));
    EXPECT_TRUE(std::isfinite(summary.final_cost));
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    if (!summary.usable) {
      EXPECT_TRUE(sameBytes(batch, start));
    } else {
      EXPECT_TRUE(std::isfinite(poseDifference(batch.T_ck_c1, scene.truth.T_ck_c1)));
    }
  }
}

}  // namespace
}  // namespace mvo
