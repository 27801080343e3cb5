// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eval/stage_times.hpp"
#include "support/temporary_folder.hpp"
#include "support/trajectories.hpp"

namespace mvo {
namespace {

using test::errorOf;
using test::handheld;
using test::stamped;
using test::transform;

constexpr int kFrames = 60;
constexpr std::int64_t kPeriod = 100'000'000;  // [ns]
const Eigen::Isometry3d kWorld = transform(1, -2, 3, 0.5, -0.7, 1.9);
const Eigen::Isometry3d kBodyFrame = transform(0.1, 0.05, -0.2, -0.4, 0.3, 0.8);

// A body that swings and turns, in the right half of a 40 x 40 image.
FramePoses swinging() {
  FramePoses poses;
  for (int k = 0; k < kFrames; ++k)
    poses.emplace_back(transform(2, 0.4 * std::sin(0.2 * k), 1, 0, 0, 0.05 * k));
  return poses;
}

Truth makeTruth() {
  Truth truth;
  for (int k = 0; k < kFrames; ++k) {
    truth.stamps_ns.push_back(k * kPeriod);
    truth.visibility.push_back({1, 800, 0.5, 800, 1.0, 1.0, k * kPeriod});
  }
  truth.camera = stamped(handheld(kFrames), 0, kPeriod);
  truth.bodies[1] = stamped(swinging(), 0, kPeriod);
  truth.mask = [](std::size_t) {
    cv::Mat mask = cv::Mat::zeros(40, 40, CV_8UC1);
    mask.colRange(20, 40).setTo(1);
    return mask;
  };
  return truth;
}

std::vector<StampedPose> moved(std::vector<StampedPose> poses, const Eigen::Isometry3d& left,
                               const Eigen::Isometry3d& right) {
  for (StampedPose& pose : poses) pose.T_world_body = left * pose.T_world_body * right;
  return poses;
}

// The truth in another world, the body in another frame, every tracklet labelled rightly.
Estimate perfect(const Truth& truth) {
  Estimate estimate;
  estimate.camera = moved(truth.camera, kWorld, Eigen::Isometry3d::Identity());
  estimate.motions[7] = moved(truth.bodies.at(1), kWorld, kBodyFrame);
  estimate.has_labels = true;
  for (const std::int64_t stamp : truth.stamps_ns)
    for (int i = 0; i < 10; ++i) {
      estimate.labels.push_back({stamp, i, 5, 2.0 + 3 * i, 0});
      estimate.labels.push_back({stamp, 10 + i, 30, 2.0 + 3 * i, 7});
    }
  return estimate;
}

TEST(Evaluate, ThePerfectEstimateHasNoErrors) {
  const Truth truth = makeTruth();
  const Evaluation result = evaluate(perfect(truth), truth);
  ASSERT_TRUE(result.camera);
  EXPECT_NEAR(result.camera->errors.max, 0, 1e-9);
  EXPECT_NEAR(result.camera->errors.max_angle, 0, 1e-7);
  EXPECT_NEAR(result.camera->steps.max, 0, 1e-9);
  EXPECT_NEAR(result.camera->drift->translation, 0, 1e-9);
  EXPECT_DOUBLE_EQ(result.camera->coverage, 100);
  ASSERT_EQ(result.bodies.size(), 1u);
  const BodyEvaluation& body = result.bodies[0];
  EXPECT_EQ(body.errors.frames, kFrames);
  EXPECT_NEAR(body.errors.max, 0, 1e-9);
  EXPECT_NEAR(body.errors.max_angle, 0, 1e-7);
  EXPECT_NEAR(body.steps.max, 0, 1e-9);
  EXPECT_EQ(body.ids, std::vector<int>{7});
  EXPECT_DOUBLE_EQ(body.coverage, 100);
  EXPECT_DOUBLE_EQ(body.one_label, 100);
  EXPECT_EQ(body.id_switches, 0);
  EXPECT_DOUBLE_EQ(body.segmentation.precision(), 100);
  EXPECT_DOUBLE_EQ(body.segmentation.recall(), 100);
  EXPECT_DOUBLE_EQ(result.rates.all, 100);
  EXPECT_DOUBLE_EQ(result.rates.exact_set, 100);
  EXPECT_EQ(result.third_party_frames, kFrames);
  EXPECT_TRUE(result.notes.empty()) << result.notes.front();
}

TEST(Evaluate, AnOffsetAfterFrame25IsExactlyThatError) {
  const Truth truth = makeTruth();
  Estimate estimate = perfect(truth);
  for (std::size_t k = 25; k < kFrames; ++k) {
    estimate.camera[k].T_world_body =
        estimate.camera[k].T_world_body * transform(0.03, -0.04, 0);  // in the camera's axes
    estimate.motions[7][k].T_world_body =
        kWorld * transform(0, 0, 0.2) * kWorld.inverse() * estimate.motions[7][k].T_world_body;
  }
  const Evaluation result = evaluate(estimate, truth);
  EXPECT_NEAR(result.camera->errors.max, 0.05, 1e-9);
  EXPECT_TRUE(result.camera->errors.signed_max.isApprox(Eigen::Vector3d(0.03, -0.04, 0), 1e-6));
  EXPECT_NEAR(result.camera->errors.rmse, 0.05 * std::sqrt(35.0 / 60), 1e-9);
  EXPECT_NEAR(result.bodies[0].errors.max, 0.2, 1e-9);
  EXPECT_TRUE(result.bodies[0].errors.signed_max.isApprox(Eigen::Vector3d(0, 0, 0.2), 1e-6));
  EXPECT_NEAR(result.bodies[0].steps.max, 0.2, 1e-9);
}

TEST(Evaluate, ALateIdHasItsOwnBodyFrame) {
  const Truth truth = makeTruth();
  Estimate estimate = perfect(truth);
  const auto all = estimate.motions[7];
  estimate.motions[7].assign(all.begin(), all.begin() + 30);
  estimate.motions[8] = moved({all.begin() + 30, all.end()}, Eigen::Isometry3d::Identity(), kWorld);
  for (LabelRow& label : estimate.labels)
    if (label.stamp_ns >= 30 * kPeriod && label.motion_id == 7) label.motion_id = 8;
  const Evaluation result = evaluate(estimate, truth);
  const BodyEvaluation& body = result.bodies[0];
  EXPECT_EQ(body.ids, (std::vector<int>{7, 8}));
  EXPECT_NEAR(body.errors.max, 0, 1e-9);
  EXPECT_EQ(body.steps.steps, kFrames - 2);  // none across the change
  EXPECT_EQ(body.id_switches, 1);
  EXPECT_DOUBLE_EQ(body.one_label, 100.0 * 30 / 59);  // it does not move yet in frame 0
  EXPECT_EQ(body.duplicate_frames, 0);
  EXPECT_DOUBLE_EQ(result.rates.exact_set, 100);
}

TEST(Evaluate, OfTwoIdsOnABodyTheOneWithMoreTrackletsGivesThePose) {
  const Truth truth = makeTruth();
  Estimate estimate = perfect(truth);
  auto& wrong = estimate.motions[8] = estimate.motions[7];
  wrong.resize(50);
  for (std::size_t k = 25; k < 50; ++k)
    wrong[k].T_world_body = transform(1, 0, 0) * wrong[k].T_world_body;
  for (std::size_t k = 0; k < 50; ++k) {  // two more tracklets, against ten
    estimate.labels.push_back({truth.stamps_ns[k], 100, 35, 10, 8});
    estimate.labels.push_back({truth.stamps_ns[k], 101, 35, 20, 8});
  }
  const Evaluation result = evaluate(estimate, truth);
  EXPECT_EQ(result.bodies[0].duplicate_frames, 50);
  EXPECT_NEAR(result.bodies[0].errors.max, 0, 1e-9);
  EXPECT_NEAR(result.rates.all, 100.0 * 10 / 60, 1e-9);
}

TEST(Evaluate, AHiddenBodyIsJudgedPerStretch) {
  Truth truth = makeTruth();
  for (std::size_t k = 30; k < 40; ++k) truth.visibility[k].image_share = 0;
  Estimate estimate = perfect(truth);
  auto& poses = estimate.motions[7];
  for (std::size_t k = 40; k < kFrames; ++k)
    poses[k].T_world_body = transform(0, 0.3, 0) * poses[k].T_world_body;
  poses.erase(poses.begin() + 20, poses.begin() + 40);
  const BodyEvaluation body = evaluate(estimate, truth).bodies[0];
  ASSERT_EQ(body.stretches.size(), 2u);
  EXPECT_EQ(body.stretches[0].stretch.last, 29u);
  EXPECT_EQ(body.stretches[0].errors.frames, 20);
  EXPECT_EQ(body.stretches[1].stretch.first, 40u);
  EXPECT_EQ(body.stretches[1].errors.frames, 20);
  EXPECT_GT(body.stretches[1].errors.max, 0.2);
  EXPECT_EQ(body.visible_frames, 50);
  EXPECT_DOUBLE_EQ(body.coverage_visible, 80);
}

TEST(Evaluate, AnEmptyLabelsFileIsAWrongCountInEveryFrame) {
  const Truth truth = makeTruth();
  Estimate estimate = perfect(truth);
  estimate.labels.clear();
  EXPECT_EQ(evaluate(estimate, truth).counts.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(evaluate(estimate, truth).rates.all, 0);
  estimate.has_labels = false;
  EXPECT_TRUE(evaluate(estimate, truth).counts.empty());
}

TEST(Evaluate, LessTruthGivesFewerFigures) {
  Truth truth = makeTruth();
  const Estimate estimate = perfect(truth);
  truth.bodies.clear();
  truth.visibility.clear();
  truth.mask = nullptr;
  const Evaluation result = evaluate(estimate, truth);
  EXPECT_NEAR(result.camera->errors.max, 0, 1e-9);
  EXPECT_TRUE(result.bodies.empty());
  EXPECT_TRUE(result.counts.empty());
  EXPECT_FALSE(result.static_world);
  EXPECT_EQ(result.third_party_frames, kFrames);
  EXPECT_FALSE(result.boxes);
}

TEST(Evaluate, BoxesTellOfLabelsPosesAndVelocities) {
  Truth truth = makeTruth();
  truth.mask = nullptr;
  truth.bodies.clear();
  truth.visibility.clear();
  truth.camera = stamped(FramePoses(kFrames, transform(0, 0, 0)), 0, kPeriod);
  truth.calibration = StereoCamera{20, 20, 20, 20, 0.1, 40, 40};
  FramePoses car;
  for (int k = 0; k < kFrames; ++k) {
    truth.boxes.push_back({k * kPeriod, 22, 0, 18, 40, "A", k < 10 ? "pole" : ""});
    car.emplace_back(transform(2 + 0.02 * k, 0, 5));
  }
  truth.boxes.push_back({99 * kPeriod, 22, 0, 18, 40, "B", ""});  // after the last frame
  truth.velocities = {{"A", 20 * kPeriod, 40 * kPeriod, 0.5, 0, 0.1}};
  Estimate estimate = perfect(makeTruth());
  estimate.camera = moved(truth.camera, kWorld, Eigen::Isometry3d::Identity());
  estimate.motions[7] = moved(stamped(car, 0, kPeriod), kWorld, Eigen::Isometry3d::Identity());
  const Evaluation result = evaluate(estimate, truth);
  ASSERT_TRUE(result.boxes);
  EXPECT_EQ(result.boxes->own_label.frames, 50);
  EXPECT_EQ(result.boxes->own_label.labelled, 50);
  ASSERT_EQ(result.boxes->bodies.size(), 1u);
  EXPECT_EQ(result.boxes->bodies[0].found, kFrames);
  EXPECT_EQ(result.boxes->bodies[0].placement->inside, kFrames);
  EXPECT_DOUBLE_EQ(result.boxes->background.labels.staticPercent(), 100);
  ASSERT_EQ(result.boxes->velocities.size(), 1u);
  EXPECT_EQ(result.boxes->velocities[0].id, 7);
  EXPECT_NEAR(result.boxes->velocities[0].errorX(), -0.3, 1e-9);
  estimate.has_labels = false;
  EXPECT_FALSE(evaluate(estimate, truth).boxes);
}

TEST(Evaluate, WithoutMasksMotionsBelongToTheBodyTheyFit) {
  Truth truth = makeTruth();
  FramePoses other(kFrames);
  for (int k = 0; k < kFrames; ++k) other[k] = transform(0.05 * k, 0, 1, 0.1 * k, 0, 0);
  truth.bodies[2] = stamped(other, 0, kPeriod);
  Estimate estimate = perfect(truth);
  estimate.motions[9] = moved(truth.bodies[2], kWorld, kBodyFrame);
  truth.mask = nullptr;
  truth.visibility.clear();
  const Evaluation result = evaluate(estimate, truth);
  ASSERT_EQ(result.bodies.size(), 2u);
  EXPECT_EQ(result.bodies[0].ids, std::vector<int>{7});
  EXPECT_EQ(result.bodies[1].ids, std::vector<int>{9});
  EXPECT_NEAR(result.bodies[1].errors.max, 0, 1e-9);
  EXPECT_FALSE(result.bodies[1].has_masks);
}

TEST(Evaluate, AnotherCameraFrameIsNoticedAndCanBeAligned) {
  const Truth truth = makeTruth();
  Estimate estimate = perfect(truth);
  const Eigen::Isometry3d forward = transform(0, 0, 0, 0, M_PI / 2, 0);  // z to x
  estimate.camera = moved(estimate.camera, Eigen::Isometry3d::Identity(), forward);
  const Evaluation left = evaluate(estimate, truth);
  ASSERT_FALSE(left.notes.empty());
  EXPECT_NE(left.notes[0].find("left-right"), std::string::npos);
  EXPECT_GT(left.camera->errors.max, 0.1);
  const Evaluation both = evaluate(estimate, truth, {CameraAlignment::kLeftRight});
  EXPECT_LT(both.camera->errors.max, 0.01);
  EXPECT_TRUE(both.notes.empty());
}

TEST(Evaluate, ForeignStampsAreAnError) {
  const Truth truth = makeTruth();
  Estimate estimate = perfect(truth);
  for (StampedPose& pose : estimate.camera) pose.stamp_ns += 1'000'000'000'000;
  for (LabelRow& label : estimate.labels) label.stamp_ns += 1'000'000'000'000;
  EXPECT_NE(errorOf([&] { evaluate(estimate, truth); }).find("share no frame"), std::string::npos);
}

TEST(CropToEstimate, KeepsTheFramesTheEstimateHasSeen) {
  Truth truth = makeTruth();
  truth.mask = [](std::size_t frame) {
    return cv::Mat(1, 1, CV_8UC1, cv::Scalar(static_cast<double>(frame)));
  };
  Estimate estimate;
  estimate.camera = {truth.camera.begin() + 10, truth.camera.begin() + 20};
  estimate.timings = {{truth.stamps_ns[22], "total", 5}};
  const Truth cropped = cropToEstimate(truth, estimate);
  ASSERT_EQ(cropped.stamps_ns.size(), 13u);
  EXPECT_EQ(cropped.stamps_ns.front(), truth.stamps_ns[10]);
  EXPECT_EQ(cropped.mask(2).at<unsigned char>(0, 0), 12);
}

TEST(StageTimes, AreSummedUnlessThereIsATotal) {
  const auto times = stageTimes({{0, "track", 1},
                                 {0, "solve", 10},
                                 {1, "track", 3},
                                 {1, "solve", 20},
                                 {2, "track", 2},
                                 {2, "solve", 60},
                                 {2, "total", 70}});
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0].stage, "track");
  EXPECT_DOUBLE_EQ(times[0].median, 2);
  EXPECT_DOUBLE_EQ(times[0].mean, 2);
  EXPECT_DOUBLE_EQ(times[0].max, 3);
  EXPECT_EQ(times[2].stage, "step");
  EXPECT_EQ(times[2].frames, 3);
  EXPECT_DOUBLE_EQ(times[2].median, 23);
  EXPECT_DOUBLE_EQ(times[2].p95, 70);
  EXPECT_TRUE(stageTimes({}).empty());
}

}  // namespace
}  // namespace mvo
