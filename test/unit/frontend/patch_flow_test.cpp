// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/patch_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;

constexpr int kSide = 13;
constexpr int kLevels = 3;
const cv::Size kSize(240, 180);

// The image moved by any number of pixels.
cv::Mat translated(const cv::Mat& image, double du, double dv) {
  cv::Mat moved;
  const cv::Matx23d shift(1, 0, du, 0, 1, dv);
  cv::warpAffine(image, moved, shift, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return moved;
}

struct Shift {
  double u;
  double v;
};

class PatchFlowShifts : public testing::TestWithParam<Shift> {};

// By what LK of OpenCV finds, from the same start.
TEST_P(PatchFlowShifts, AreFoundAsOpenCvFindsThem) {
  const auto [u, v] = GetParam();
  const cv::Mat a = randomTexture(kSize, 1);
  const cv::Mat b = translated(a, u, v);
  const auto pyramid_a = buildPaddedPyramid(a, kSide, kLevels);
  const auto pyramid_b = buildPaddedPyramid(b, kSide, kLevels);
  std::vector<cv::Point2f> from;
  for (int x = 60; x < 190; x += 13)
    for (int y = 60; y < 130; y += 11) from.emplace_back(x + 0.3F, y + 0.6F);
  std::vector<cv::Point2f> reference = from;
  std::vector<unsigned char> ok;
  cv::calcOpticalFlowPyrLK(a, b, from, reference, ok, cv::noArray(), {kSide, kSide}, kLevels,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  PatchFlow flow(kSide);
  int theirs = 0;
  int ours = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Point2f truth = from[i] + cv::Point2f(static_cast<float>(u), static_cast<float>(v));
    theirs += ok[i] != 0 && cv::norm(reference[i] - truth) < 0.1 ? 1 : 0;
    cv::Point2f q = from[i];
    flow.take(pyramid_a, from[i], kLevels);
    ours += flow.follow(pyramid_b, q) && cv::norm(q - truth) < 0.1 ? 1 : 0;
  }
  EXPECT_GE(ours, static_cast<int>(0.97 * theirs));
  EXPECT_GE(ours, static_cast<int>(0.9 * static_cast<double>(from.size())));
}

INSTANTIATE_TEST_SUITE_P(Shifts, PatchFlowShifts,
                         testing::Values(Shift{0, 0}, Shift{0.4, -0.3}, Shift{3.7, 2.2},
                                         Shift{-14, 9}));

TEST(PatchFlow, OnePatchServesSeveralImages) {
  const cv::Mat a = randomTexture(kSize, 2);
  PatchFlow flow(kSide);
  flow.take(buildPaddedPyramid(a, kSide, 1), {100, 80}, 1);
  for (const float shift : {-2.0F, 1.5F}) {
    cv::Point2f q(100, 80);
    ASSERT_TRUE(flow.follow(buildPaddedPyramid(translated(a, shift, 0), kSide, 1), q));
    EXPECT_NEAR(q.x, 100 + shift, 0.1);
  }
}

struct Light {
  double gain;
  double offset;
};

class PatchFlowLights : public testing::TestWithParam<Light> {};

// Exposure, an aperture, an eye that is darker: the place does not depend on them.
TEST_P(PatchFlowLights, DoNotMoveThePlace) {
  const cv::Mat a = randomTexture(kSize, 6, 40);
  const cv::Mat b = translated(a, 3.7, -2.2);
  cv::Mat lit;
  b.convertTo(lit, CV_8U, GetParam().gain, GetParam().offset);
  const auto pyramid_a = buildPaddedPyramid(a, kSide, kLevels);
  const auto pyramid_b = buildPaddedPyramid(b, kSide, kLevels);
  const auto pyramid_lit = buildPaddedPyramid(lit, kSide, kLevels);
  PatchFlow flow(kSide);
  int all = 0;
  int same = 0;
  for (int column = 0; column < 10; ++column)
    for (int row = 0; row < 7; ++row) {
      const float x = 60.3F + 13.0F * static_cast<float>(column);
      const float y = 60.6F + 11.0F * static_cast<float>(row);
      cv::Point2f expected(x, y);
      flow.take(pyramid_a, {x, y}, kLevels);
      if (!flow.follow(pyramid_b, expected)) continue;
      ++all;
      for (const bool back : {false, true}) {  // from the dark into the light, and the other way
        cv::Point2f q(x, y);
        if (back) flow.take(pyramid_lit, expected, kLevels);
        if (!flow.follow(back ? pyramid_a : pyramid_lit, q)) continue;
        same += cv::norm(q - (back ? cv::Point2f(x, y) : expected)) < 0.15 ? 1 : 0;
      }
    }
  EXPECT_GT(all, 60);
  EXPECT_GE(same, 1.9 * all);
}

INSTANTIATE_TEST_SUITE_P(Lights, PatchFlowLights,
                         testing::Values(Light{1, 0}, Light{1, 60}, Light{0.1, 0}, Light{0.3, 0},
                                         Light{0.8, 0}, Light{1.5, -64}, Light{3, -256}));

TEST(PatchFlow, PointsNextToTheImagesEndAreFollowed) {
  const cv::Mat a = randomTexture(kSize, 3);
  const auto pyramid = buildPaddedPyramid(a, kSide, kLevels);
  PatchFlow flow(kSide);
  for (const cv::Point2f p : {cv::Point2f(2, 90), cv::Point2f(237, 90), cv::Point2f(120, 2),
                              cv::Point2f(120, 177), cv::Point2f(0, 0), cv::Point2f(239, 179)}) {
    cv::Point2f q = p;
    flow.take(pyramid, p, kLevels);
    ASSERT_TRUE(flow.follow(pyramid, q)) << p;
    EXPECT_LT(cv::norm(q - p), 0.02) << p;
  }
}

TEST(PatchFlow, NothingWithoutTextureOrOutside) {
  const auto texture = buildPaddedPyramid(randomTexture(kSize, 4), kSide, kLevels);
  const auto flat = buildPaddedPyramid(cv::Mat(kSize, CV_8U, cv::Scalar(90)), kSide, kLevels);
  PatchFlow flow(kSide);
  cv::Point2f q(100, 80);
  EXPECT_FALSE(flow.follow(texture, q)) << "nothing was taken yet";
  flow.take(flat, {100, 80}, kLevels);
  EXPECT_FALSE(flow.follow(texture, q));
  for (const cv::Point2f p : {cv::Point2f(-3, 80), cv::Point2f(100, 500), cv::Point2f(NAN, 80)}) {
    flow.take(texture, p, kLevels);
    q = {100, 80};
    EXPECT_FALSE(flow.follow(texture, q)) << p;
    flow.take(texture, {100, 80}, kLevels);
    q = p;
    EXPECT_FALSE(flow.follow(texture, q)) << p;
  }
}

TEST(PaddedPyramid, HalvesUntilPatchesNoLongerFit) {
  const cv::Mat image = randomTexture({100, 60}, 5);
  const auto pyramid = buildPaddedPyramid(image, kSide, 5);
  ASSERT_EQ(pyramid.size(), 3U);
  EXPECT_EQ(cv::norm(pyramid[0], image, cv::NORM_INF), 0);
  EXPECT_EQ(pyramid[2].size(), cv::Size(25, 15));
  cv::Mat half;
  cv::pyrDown(image, half);
  EXPECT_EQ(cv::norm(pyramid[1], half, cv::NORM_INF), 0);
  EXPECT_EQ(pyramid[1].ptr(3)[-2], pyramid[1].ptr(3)[2]) << "mirrored beyond its border";
}

}  // namespace
}  // namespace mvo
