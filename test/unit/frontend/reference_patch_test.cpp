// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/reference_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;

constexpr int kSide = 21;
constexpr int kSteps = 30;
const cv::Size kSize(160, 120);
const Eigen::Vector2f kCentre(80, 60);

// What `warp` says of the patch around kCentre: image(warp(x)) = texture(kCentre + x).
cv::Mat seen(const cv::Mat& texture, const PatchWarp& warp, double gain, double offset) {
  const Eigen::Vector2f t = warp.t - warp.A * kCentre;
  const cv::Mat m = (cv::Mat_<double>(2, 3) << warp.A(0, 0), warp.A(0, 1), t.x(), warp.A(1, 0),
                     warp.A(1, 1), t.y());
  cv::Mat image;
  cv::warpAffine(texture, image, m, texture.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  image.convertTo(image, CV_8U, gain, offset);
  return image;
}

// Largest distance of the patch's corners and centre under two warps [px].
float farthest(const PatchWarp& a, const PatchWarp& b) {
  float most = 0;
  for (const float x : {-1.0F, 0.0F, 1.0F})
    for (const float y : {-1.0F, 0.0F, 1.0F}) {
      const Eigen::Vector2f p = 0.25F * static_cast<float>(kSide - 1) * Eigen::Vector2f(x, y);
      most = std::max(most, (a.A * p + a.t - b.A * p - b.t).norm());
    }
  return most;
}

class AffineWarps : public testing::TestWithParam<std::uint64_t> {};

TEST_P(AffineWarps, AreRecoveredUnderGainAndOffset) {
  const cv::Mat texture = randomTexture(kSize, GetParam());
  const auto patch = ReferencePatch::take(texture, kCentre, kSide);
  ASSERT_TRUE(patch);
  PatchWarp truth;
  truth.A << 1.06F, 0.05F, -0.07F, 0.95F;
  truth.t = kCentre + Eigen::Vector2f(0.7F, -0.45F);
  const PatchWarp start{Eigen::Matrix2f::Identity(), kCentre};
  const auto found = patch->align(seen(texture, truth, 0.7, 30), start, kSteps);
  ASSERT_TRUE(found);
  EXPECT_GT(found->correlation, 0.98F);
  EXPECT_LT((found->warp.t - truth.t).norm(), 0.05F);
  EXPECT_LT(farthest(found->warp, truth), 0.25F) << "the affine part is damped, but not absent";
  EXPECT_LT(farthest(found->warp, truth), 0.5F * farthest({start.A, truth.t}, truth));
}

INSTANTIATE_TEST_SUITE_P(Textures, AffineWarps, testing::Values(1, 2, 3, 4, 5));

TEST(ReferencePatch, StaysWhereItWasTaken) {
  const cv::Mat texture = randomTexture(kSize, 6);
  const Eigen::Vector2f between(80.3F, 60.8F);
  const auto patch = ReferencePatch::take(texture, between, kSide);
  ASSERT_TRUE(patch);
  const auto found = patch->align(texture, {Eigen::Matrix2f::Identity(), between}, kSteps);
  ASSERT_TRUE(found);
  EXPECT_LT((found->warp.t - between).norm(), 1e-3F);
  EXPECT_NEAR(found->correlation, 1, 1e-4);
}

TEST(ReferencePatch, NoneFromFlatOrSaturatedImages) {
  for (const int grey : {0, 90, 255})
    EXPECT_FALSE(ReferencePatch::take(cv::Mat(kSize, CV_8U, cv::Scalar(grey)), kCentre, kSide));
}

TEST(ReferencePatch, NoneOutsideTheImage) {
  const cv::Mat texture = randomTexture(kSize, 7);
  EXPECT_FALSE(ReferencePatch::take(texture, {5, 60}, kSide));
  EXPECT_FALSE(ReferencePatch::take(texture, {80, 115}, kSide));
  EXPECT_FALSE(ReferencePatch::take(texture, {-300, 60}, kSide));
  EXPECT_FALSE(ReferencePatch::take(texture, {NAN, 60}, kSide));
}

TEST(ReferencePatch, AlignsNowhereInFlatImagesOrOutside) {
  const cv::Mat texture = randomTexture(kSize, 8);
  const auto patch = ReferencePatch::take(texture, kCentre, kSide);
  ASSERT_TRUE(patch);
  const Eigen::Matrix2f I = Eigen::Matrix2f::Identity();
  EXPECT_FALSE(patch->align(cv::Mat(kSize, CV_8U, cv::Scalar(90)), {I, kCentre}, kSteps));
  EXPECT_FALSE(patch->align(texture, {I, {4, 60}}, kSteps));
  EXPECT_FALSE(patch->align(texture, {I, {80, 200}}, kSteps));
  EXPECT_FALSE(patch->align(texture, {I, {NAN, 60}}, kSteps));
}

TEST(ReferencePatch, AnotherTextureDoesNotAgree) {
  const auto patch = ReferencePatch::take(randomTexture(kSize, 9), kCentre, kSide);
  ASSERT_TRUE(patch);
  const auto found =
      patch->align(randomTexture(kSize, 10), {Eigen::Matrix2f::Identity(), kCentre}, kSteps);
  EXPECT_TRUE(!found || found->correlation < 0.8F);
}

}  // namespace
}  // namespace mvo
