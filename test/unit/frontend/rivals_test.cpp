// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/rivals.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "frontend/patch_flow.hpp"
#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;
using test_support::repeated;

const cv::Size kSize(240, 180);

std::vector<cv::Mat> pyramidOf(const cv::Mat& image) { return buildPaddedPyramid(image, 13, 3); }

TEST(Rivals, LieAPeriodApartBothWays) {
  for (const int period : {10, 14, 20}) {
    const auto pyramid = pyramidOf(repeated(randomTexture({period, kSize.height}, 4), kSize));
    const auto rivals = findRivals(pyramid, {120, 90});
    ASSERT_GE(rivals.size(), 2U) << period;
    for (const Eigen::Vector2f& d : rivals) EXPECT_GE(d.norm(), kNearestRival);
    for (const float way : {-1.0F, 1.0F})
      EXPECT_TRUE(std::any_of(rivals.begin(), rivals.begin() + 2, [&](const auto& d) {
        return (d - Eigen::Vector2f(way * static_cast<float>(period), 0)).norm() <= 2;
      })) << period;
  }
}

TEST(Rivals, AreNoneOfMostPlacesOfAUniqueTexture) {
  const auto pyramid = pyramidOf(randomTexture(kSize, 5));
  int unique = 0;
  int all = 0;
  for (int v = 30; v < kSize.height - 30; v += 10)
    for (int u = 30; u < kSize.width - 30; u += 10) {
      const auto rivals = findRivals(pyramid, {static_cast<float>(u), static_cast<float>(v)});
      unique += rivals.empty() ? 1 : 0;
      ++all;
    }
  EXPECT_GT(unique, 0.9 * all);
}

TEST(Rivals, AreNoneInFlatImagesAndBeyondTheImage) {
  const auto flat = pyramidOf(cv::Mat(kSize, CV_8U, cv::Scalar(90)));
  EXPECT_TRUE(findRivals(flat, {120, 90}).empty());
  const auto pyramid = pyramidOf(repeated(randomTexture({14, kSize.height}, 4), kSize));
  for (const cv::Point2f& p : {cv::Point2f(0, 0), cv::Point2f(239, 179), cv::Point2f(-30, 400)})
    EXPECT_TRUE(findRivals(pyramid, p).empty());
}

TEST(Rivals, AreFoundInAnImageWithoutLevels) {
  const cv::Mat image = repeated(randomTexture({10, kSize.height}, 4), kSize);
  EXPECT_FALSE(findRivals(buildPaddedPyramid(image, 13, 0), {120, 90}).empty());
}

}  // namespace
}  // namespace mvo
