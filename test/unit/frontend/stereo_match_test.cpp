// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/stereo_match.hpp"

#include <gtest/gtest.h>

#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;
using test_support::translated;

// -1 if there is none.
double disparityOf(const cv::Mat& left, const cv::Mat& right, const cv::Point2f& p,
                   const StereoSearch& search) {
  const auto match = searchEpipolarLine(left, right, p, search);
  return match ? match->disparity : -1;
}

TEST(StereoMatch, FindsTheShiftOfATexture) {
  const cv::Mat left = randomTexture({200, 60}, 1);
  for (const int disparity : {0, 1, 17, 60}) {
    const cv::Mat right = translated(left, -disparity, 0);
    for (const int u : {100, 140, 185})
      EXPECT_EQ(disparityOf(left, right, cv::Point2f(static_cast<float>(u), 30), {}), disparity)
          << u;
  }
}

TEST(StereoMatch, GainAndOffsetDoNotMatter) {
  const cv::Mat left = randomTexture({200, 60}, 2);
  cv::Mat right;
  translated(left, -12, 0).convertTo(right, CV_8U, 0.6, 40);
  EXPECT_EQ(disparityOf(left, right, {120, 30}, {}), 12);
}

TEST(StereoMatch, FindsTheRowOfAPairThatIsNotLevel) {
  const cv::Mat left = randomTexture({200, 60}, 7);
  StereoSearch search;
  search.first_down = -5;
  search.last_down = 5;
  for (const int down : {-5, -2, 0, 3}) {
    const auto match = searchEpipolarLine(left, translated(left, -17, down), {120, 30}, search);
    ASSERT_TRUE(match) << down;
    EXPECT_EQ(match->disparity, 17);
    EXPECT_EQ(match->down, down);
  }
  EXPECT_FALSE(searchEpipolarLine(left, translated(left, -17, 9), {120, 30}, search));
}

TEST(StereoMatch, NothingBeyondTheLargestDisparity) {
  const cv::Mat left = randomTexture({200, 60}, 3);
  const cv::Mat right = translated(left, -40, 0);
  StereoSearch search;
  search.max_disparity = 30;
  EXPECT_FALSE(searchEpipolarLine(left, right, {150, 30}, search));
  search.max_disparity = 50;
  EXPECT_EQ(disparityOf(left, right, {150, 30}, search), 40);
}

TEST(StereoMatch, NothingOnFlatPatches) {
  const cv::Mat flat(60, 200, CV_8U, cv::Scalar(90));
  EXPECT_FALSE(searchEpipolarLine(flat, flat, {100, 30}, {}));
  EXPECT_FALSE(searchEpipolarLine(flat, randomTexture({200, 60}, 4), {100, 30}, {}));
}

TEST(StereoMatch, NothingOnTexturesThatRepeat) {
  const cv::Mat tile = randomTexture({20, 60}, 5);
  cv::Mat repeated;
  cv::repeat(tile, 1, 10, repeated);
  EXPECT_FALSE(searchEpipolarLine(repeated, repeated, {150, 30}, {}));
}

TEST(StereoMatch, NothingForAnotherTexture) {
  cv::RNG random(6);
  cv::Mat left(60, 200, CV_8U);
  cv::Mat right(60, 200, CV_8U);
  random.fill(left, cv::RNG::UNIFORM, 0, 256);
  random.fill(right, cv::RNG::UNIFORM, 0, 256);
  for (const float u : {60.0F, 100.0F, 150.0F})
    EXPECT_FALSE(searchEpipolarLine(left, right, {u, 30}, {})) << u;
  EXPECT_EQ(disparityOf(left, left, {100, 30}, {}), 0);
}

TEST(StereoMatch, NothingWhereThePatchLeavesTheImage) {
  const cv::Mat image = randomTexture({200, 60}, 8);
  for (const cv::Point2f p : {cv::Point2f(3, 30), cv::Point2f(197, 30), cv::Point2f(100, 3),
                              cv::Point2f(100, 57), cv::Point2f(-50, -50)})
    EXPECT_FALSE(searchEpipolarLine(image, image, p, {})) << p;
  EXPECT_EQ(disparityOf(image, image, {195, 55}, {}), 0);
}

}  // namespace
}  // namespace mvo
