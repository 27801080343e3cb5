// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mvo/se3.hpp"
#include "support/trajectories.hpp"

namespace mvo {
namespace {

using test::handheld;
using test::transform;

const Eigen::Isometry3d kWorld = transform(1, -2, 3, 0.5, -0.7, 1.9);
const Eigen::Isometry3d kBody = transform(0.1, 0.05, -0.2, -0.4, 0.3, 0.8);

// Estimates P_k = A^-1 G_k B^-1.
FramePoses estimateOf(const FramePoses& truth, const Eigen::Isometry3d& A,
                      const Eigen::Isometry3d& B) {
  FramePoses estimate = truth;
  for (auto& pose : estimate)
    if (pose) pose = A.inverse() * *pose * B.inverse();
  return estimate;
}

TEST(AlignLeft, FindsTheWorldOfAPerfectEstimate) {
  const FramePoses truth = handheld(40);
  const FramePoses estimate = estimateOf(truth, kWorld, Eigen::Isometry3d::Identity());
  const auto alignment = alignLeft(estimate, truth);
  ASSERT_TRUE(alignment);
  EXPECT_TRUE(alignment->A.isApprox(kWorld, 1e-9));
  EXPECT_TRUE(alignment->B.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_NEAR(misfit(*alignment, estimate, truth), 0, 1e-9);
}

TEST(AlignLeft, OnlyTheFirst25PosesCount) {
  const FramePoses truth = handheld(60);
  FramePoses estimate = truth;
  for (std::size_t k = 25; k < estimate.size(); ++k)
    estimate[k] = transform(5, 5, 5, 1, 1, 1) * *estimate[k];
  const auto alignment = alignLeft(estimate, truth);
  ASSERT_TRUE(alignment);
  EXPECT_TRUE(alignment->A.isApprox(Eigen::Isometry3d::Identity(), 1e-9));
  estimate[24] = transform(5, 5, 5, 1, 1, 1) * *truth[24];  // the 25th does
  EXPECT_FALSE(alignLeft(estimate, truth)->A.isApprox(Eigen::Isometry3d::Identity(), 1e-3));
}

TEST(AlignLeft, TheFirst25PosesOfALateEstimateCount) {
  const FramePoses truth = handheld(80);
  FramePoses estimate = estimateOf(truth, kWorld, Eigen::Isometry3d::Identity());
  for (std::size_t k = 0; k < 40; ++k) estimate[k].reset();
  EXPECT_TRUE(alignLeft(estimate, truth)->A.isApprox(kWorld, 1e-9));
}

TEST(AlignLeft, AStandingCameraIsAlignedByItsOrientations) {
  const FramePoses truth(30, kWorld);
  const FramePoses estimate(30, Eigen::Isometry3d::Identity());
  const auto alignment = alignLeft(estimate, truth);
  ASSERT_TRUE(alignment);
  EXPECT_TRUE(alignment->A.isApprox(kWorld, 1e-9));
}

TEST(AlignLeft, WeighsOneRadianLikeOneMetre) {
  const double phi = 0.8;
  FramePoses truth(2, Eigen::Isometry3d::Identity());
  FramePoses estimate = truth;
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? -0.5 : 0.5;
    estimate[k]->translation() << side, 0, 0;
    truth[k]->translation() << side * std::cos(phi), side * std::sin(phi), 0;
  }
  // Planar correlation: rotations 2 I, positions 0.5 (cos, sin)^T (1, 0): M11 = 2 + 0.5 cos phi,
  // M21 = 0.5 sin phi, M22 = 2, M12 = 0; the nearest rotation turns by atan2(M21 - M12, M11 + M22).
  const double expected = std::atan2(0.5 * std::sin(phi), 4 + 0.5 * std::cos(phi));
  const auto alignment = alignLeft(estimate, truth);
  ASSERT_TRUE(alignment);
  EXPECT_NEAR(rotationVector(alignment->A.linear()).z(), expected, 1e-12);
}

TEST(AlignLeft, NoCommonFrameIsNone) {
  FramePoses truth = handheld(10);
  FramePoses estimate = truth;
  for (std::size_t k = 0; k < 10; ++k) (k < 5 ? truth[k] : estimate[k]).reset();
  EXPECT_FALSE(alignLeft(estimate, truth));
  EXPECT_FALSE(alignLeftRight(estimate, truth));
  EXPECT_FALSE(alignBody(estimate, truth, kWorld));
  EXPECT_FALSE(alignLeft({}, {}));
}

TEST(AlignLeftRight, FindsWorldAndCameraFrame) {
  const FramePoses truth = handheld(60);
  const FramePoses estimate = estimateOf(truth, kWorld, kBody);
  const auto alignment = alignLeftRight(estimate, truth);
  ASSERT_TRUE(alignment);
  EXPECT_LT(angle(alignment->A.linear().transpose() * kWorld.linear()), 1e-6);
  EXPECT_LT(angle(alignment->B.linear().transpose() * kBody.linear()), 1e-6);
  // The weak ridge keeps the lever arm a little short.
  EXPECT_LT((alignment->B.translation() - kBody.translation()).norm(), 0.05);
  EXPECT_LT(misfit(*alignment, estimate, truth), 0.01);
}

TEST(AlignLeftRight, IsNearTheIdentityForThePerfectEstimate) {
  const FramePoses truth = handheld(60);
  const auto alignment = alignLeftRight(truth, truth);
  ASSERT_TRUE(alignment);
  EXPECT_TRUE(alignment->A.isApprox(Eigen::Isometry3d::Identity(), 1e-6));
  EXPECT_TRUE(alignment->B.isApprox(Eigen::Isometry3d::Identity(), 1e-6));
}

TEST(AlignLeftRight, WithoutRotationTheLeverArmStaysZero) {
  FramePoses truth(30, Eigen::Isometry3d::Identity());
  for (int k = 0; k < 30; ++k) truth[k]->translation().x() = 0.1 * k;
  const auto alignment = alignLeftRight(truth, truth);
  ASSERT_TRUE(alignment);
  EXPECT_LT(alignment->B.translation().norm(), 1e-9);
  EXPECT_LT(misfit(*alignment, truth, truth), 1e-9);
}

TEST(AlignBody, FindsTheBodyFrame) {
  const FramePoses truth = handheld(60);
  const FramePoses estimate = estimateOf(truth, kWorld, kBody);
  const auto alignment = alignBody(estimate, truth, kWorld);
  ASSERT_TRUE(alignment);
  EXPECT_TRUE(alignment->A.isApprox(kWorld));
  EXPECT_TRUE(alignment->B.isApprox(kBody, 1e-9));
  for (std::size_t k = 0; k < truth.size(); ++k)
    EXPECT_TRUE((*alignment)(*estimate[k]).isApprox(*truth[k], 1e-9));
}

}  // namespace
}  // namespace mvo
