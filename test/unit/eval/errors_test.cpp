// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/trajectories.hpp"

namespace mvo {
namespace {

using test::handheld;
using test::transform;

AlignedTrack track(const FramePoses& poses, int id = 0) {
  AlignedTrack result(poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (poses[k]) result[k] = AlignedPose{id, *poses[k]};
  return result;
}

TEST(RollPitchYaw, AreTheAnglesAboutXYZ) {
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  EXPECT_TRUE(rollPitchYaw(R).isApprox(Eigen::Vector3d(0.1, -0.2, 0.3), 1e-12));
}

TEST(CameraErrors, AreInTheCamerasAxes) {
  FramePoses truth(1, transform(1, 2, 3, 0, M_PI / 2, 0));  // its z axis is the world's x
  FramePoses estimate(1, transform(1.5, 2, 3, 0, M_PI / 2, 0));
  const auto errors = cameraErrors(track(estimate), truth);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(errors[0].translation.isApprox(Eigen::Vector3d(0, 0, 0.5), 1e-12));
  EXPECT_NEAR(errors[0].angle, 0, 1e-12);
}

TEST(BodyErrors, AreInTheWorldsAxes) {
  FramePoses truth(1, transform(1, 2, 3, 0, M_PI / 2, 0));
  FramePoses estimate(1, transform(0, 0, 0, 0.25, 0, 0) * *truth[0]);
  estimate[0]->translation() << 1.5, 2, 3;
  const auto errors = bodyErrors(track(estimate), truth);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(errors[0].translation.isApprox(Eigen::Vector3d(0.5, 0, 0), 1e-12));
  EXPECT_TRUE(errors[0].roll_pitch_yaw.isApprox(Eigen::Vector3d(0.25, 0, 0), 1e-9));
  EXPECT_NEAR(errors[0].angle, 0.25, 1e-9);
}

TEST(Errors, OnlyFramesWithBothPosesCount) {
  FramePoses truth = handheld(4);
  FramePoses estimate = truth;
  truth[1].reset();
  estimate[2].reset();
  const auto errors = cameraErrors(track(estimate), truth);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0].frame, 0u);
  EXPECT_EQ(errors[1].frame, 3u);
}

TEST(ErrorSummary, MaximaKeepTheirSigns) {
  std::vector<PoseError> errors(2);
  errors[0] = {0, {0.3, -0.4, 0}, {0.1, 0, 0}, 0.1, 0};
  errors[1] = {7, {-0.5, 0.1, 0}, {-0.2, 0.05, 0}, 0.3, 0};
  const ErrorSummary summary = summarize(errors, 5.0);
  EXPECT_EQ(summary.frames, 2);
  EXPECT_NEAR(summary.max, std::sqrt(0.26), 1e-12);
  EXPECT_EQ(summary.max_frame, 7u);
  EXPECT_NEAR(summary.rmse, std::sqrt((0.25 + 0.26) / 2), 1e-12);
  EXPECT_NEAR(summary.max_percent, 20 * std::sqrt(0.26), 1e-12);
  EXPECT_EQ(summary.signed_max, Eigen::Vector3d(-0.5, -0.4, 0));
  EXPECT_EQ(summary.signed_max_rpy, Eigen::Vector3d(-0.2, 0.05, 0));
  EXPECT_NEAR(summary.rmse_rpy.x(), std::sqrt(0.025), 1e-12);
  EXPECT_DOUBLE_EQ(summary.max_angle, 0.3);
  EXPECT_NEAR(summary.rmse_angle, std::sqrt(0.05), 1e-12);
}

TEST(ErrorSummary, OfNothingOrOfAStandingTruthIsZero) {
  EXPECT_EQ(summarize(std::vector<PoseError>{}, 1.0).frames, 0);
  const std::vector<PoseError> errors{{0, {1, 0, 0}, {0, 0, 0}, 0, 0}};
  EXPECT_EQ(summarize(errors, 0.0).max_percent, 0);
  EXPECT_EQ(summarize(errors, 0.0).max, 1);
}

TEST(StepErrors, OfTheCameraDoNotSeeTheAlignment) {
  const FramePoses truth = handheld(20);
  FramePoses estimate = truth;
  for (auto& pose : estimate) pose = transform(3, 2, 1, 1, 0, 2) * *pose;
  const StepSummary summary = summarize(cameraStepErrors(track(estimate), truth));
  EXPECT_EQ(summary.steps, 19);
  EXPECT_NEAR(summary.max, 0, 1e-12);
  EXPECT_NEAR(summary.max_angle, 0, 1e-9);
}

TEST(StepErrors, AConstantDriftPerFrameIsThatDrift) {
  const FramePoses truth(11, Eigen::Isometry3d::Identity());
  FramePoses estimate = truth;
  for (int k = 0; k < 11; ++k) estimate[k] = transform(0.003 * k, 0, 0, 0, 0, 0.01 * k);
  const StepSummary camera = summarize(cameraStepErrors(track(estimate), truth));
  EXPECT_NEAR(camera.rmse, 0.003, 1e-12);
  EXPECT_NEAR(camera.rmse_angle, 0.01, 1e-9);
  const StepSummary body = summarize(bodyStepErrors(track(estimate), truth));
  EXPECT_NEAR(body.rmse, 0.003, 1e-12);
  EXPECT_NEAR(body.max_angle, 0.01, 1e-9);
}

TEST(StepErrors, TheLargestNamesItsFrame) {
  const FramePoses truth = handheld(20);
  FramePoses estimate = truth;
  for (std::size_t k = 7; k < 20; ++k) estimate[k] = transform(0.3, 0, 0) * *estimate[k];
  for (std::size_t k = 12; k < 20; ++k)
    estimate[k] = *estimate[k] * transform(0, 0, 0, 0, 0.2, 0);  // about the camera itself
  const StepSummary summary = summarize(cameraStepErrors(track(estimate), truth));
  EXPECT_NEAR(summary.max, 0.3, 1e-9);
  EXPECT_EQ(summary.max_frame, 7u);
  EXPECT_NEAR(summary.max_angle, 0.2, 1e-9);
  EXPECT_EQ(summary.max_angle_frame, 12u);
}

TEST(StepErrors, FramesThatAreSaidLostDoNotCount) {
  const FramePoses truth = handheld(20);
  FramePoses estimate = truth;
  estimate[7] = transform(5, 0, 0) * *estimate[7];
  EXPECT_GT(summarize(cameraStepErrors(track(estimate), truth)).max, 4.9);
  estimate[7].reset();
  EXPECT_NEAR(summarize(cameraStepErrors(track(estimate), truth)).max, 0, 1e-9);
}

TEST(PathScale, IsTakenOverTheFramesThatBothKnow) {
  FramePoses truth(10);
  FramePoses estimate(10);
  for (int k = 0; k < 10; ++k) {
    truth[k] = transform(0, 0, k);
    if (k > 2) estimate[k] = transform(1.1 * k, 4, 0);
  }
  truth[9].reset();
  EXPECT_NEAR(pathScale(track(estimate), truth).value(), 1.1, 1e-12);
  EXPECT_FALSE(pathScale(track(estimate), FramePoses(10, transform(1, 2, 3))));
  EXPECT_FALSE(pathScale(AlignedTrack(10), truth));
}

TEST(StepErrors, DoNotReachAcrossDroppedFramesOrIdChanges) {
  const FramePoses truth = handheld(10);
  AlignedTrack estimate = track(truth, 1);
  estimate[4].reset();                                       // steps 3-4 and 4-5
  for (std::size_t k = 7; k < 10; ++k) estimate[k]->id = 2;  // step 6-7
  const auto steps = bodyStepErrors(estimate, truth);
  std::vector<std::size_t> frames;
  for (const StepError& step : steps) frames.push_back(step.frame);
  EXPECT_EQ(frames, (std::vector<std::size_t>{1, 2, 3, 6, 8, 9}));
}

TEST(EndDrift, ComparesTheLastPosesFromTheFirstCommonOne) {
  FramePoses truth(12);
  FramePoses estimate(12);
  const Eigen::Isometry3d other_world = transform(4, 5, 6, 0.3, 0.2, 0.1);
  for (int k = 1; k < 11; ++k) {  // 1 m per frame ahead; estimated without the first and the last
    truth[k] = transform(0, 0, k);
    if (k >= 2) estimate[k] = other_world * transform(0, 0, k);
  }
  estimate[10] = other_world * transform(0.3, 0, 10.4, 0, 0.04, 0);
  const auto drift = endDrift(estimate, truth);
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->first_frame, 2u);
  EXPECT_EQ(drift->last_frame, 10u);
  EXPECT_NEAR(drift->path, 8, 1e-12);
  EXPECT_NEAR(drift->translation, 0.5, 1e-12);
  EXPECT_NEAR(drift->percent, 6.25, 1e-9);
  EXPECT_NEAR(drift->angle, 0.04, 1e-9);
  EXPECT_NEAR(drift->angle_per_metre, 0.005, 1e-9);
}

TEST(EndDrift, NeedsTwoCommonFrames) {
  FramePoses truth = handheld(5);
  FramePoses estimate(5);
  EXPECT_FALSE(endDrift(estimate, truth));
  estimate[3] = truth[3];
  EXPECT_FALSE(endDrift(estimate, truth));
  estimate[4] = truth[4];
  EXPECT_TRUE(endDrift(estimate, truth));
}

TEST(FrameClock, MatchesWithinThreeTenthsOfAPeriod) {
  const FrameClock clock({1000, 1100, 1200, 1500});  // period 100
  EXPECT_EQ(clock.frameOf(1100), 1u);
  EXPECT_EQ(clock.frameOf(1130), 1u);
  EXPECT_EQ(clock.frameOf(1070), 1u);
  EXPECT_FALSE(clock.frameOf(1131));
  EXPECT_FALSE(clock.frameOf(1069));
  EXPECT_EQ(clock.frameOf(970), 0u);
  EXPECT_FALSE(clock.frameOf(900));
  EXPECT_EQ(clock.frameOf(1530), 3u);
  EXPECT_FALSE(clock.frameOf(1350));
  EXPECT_FALSE(clock.frameOf(9999));
}

}  // namespace
}  // namespace mvo
