// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/corner_peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;

// OpenCV sums over the block and scales Sobel's derivatives (8 x the gradient) by
// 1 / (4 * block * 255).
constexpr double kScoreOfEigenvalue = (4.0 * 255.0 / 8.0) * (4.0 * 255.0 / 8.0);

class CornerPeaks : public testing::TestWithParam<cv::Size> {};

TEST_P(CornerPeaks, AreThoseOfTheSmallerEigenvalue) {
  const cv::Mat image = randomTexture(GetParam(), 1);
  cv::Mat eigenvalue;
  cv::cornerMinEigenVal(image, eigenvalue, 5, 3);
  eigenvalue *= kScoreOfEigenvalue;
  std::map<std::pair<int, int>, float> found;
  for (const CornerPeak& peak : findCornerPeaks(image)) {
    ASSERT_TRUE(found.emplace(std::make_pair(peak.v, peak.u), peak.score).second);
    EXPECT_NEAR(peak.score, eigenvalue.at<float>(peak.v, peak.u), 1e-4 * peak.score + 1e-3);
  }
  // Every clear peak, and no pixel that is clearly none.
  int clear = 0;
  for (int v = 4; v < image.rows - 4; ++v)
    for (int u = 4; u < image.cols - 4; ++u) {
      float rival = 0;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du)
          if (du != 0 || dv != 0) rival = std::max(rival, eigenvalue.at<float>(v + dv, u + du));
      const float score = eigenvalue.at<float>(v, u);
      const bool is_found = found.count({v, u}) != 0;
      if (score > 1.001F * rival + 0.1F) {
        EXPECT_TRUE(is_found) << u << ", " << v;
        ++clear;
      }
      if (rival > 1.001F * score + 0.1F) {
        EXPECT_FALSE(is_found) << u << ", " << v;
      }
    }
  EXPECT_GT(clear, image.cols * image.rows / 500);
}

INSTANTIATE_TEST_SUITE_P(Sizes, CornerPeaks,
                         testing::Values(cv::Size(160, 120), cv::Size(163, 64), cv::Size(75, 201)));

TEST(CornerPeaks, AreInOrderWhateverTheNumberOfThreads) {
  const cv::Mat image = randomTexture({320, 240}, 2);
  const int threads = cv::getNumThreads();
  const auto key = [](const CornerPeak& p) { return std::make_pair(p.v, p.u); };
  const auto peaks = findCornerPeaks(image);
  EXPECT_TRUE(std::is_sorted(peaks.begin(), peaks.end(),
                             [&](const auto& a, const auto& b) { return key(a) < key(b); }));
  cv::setNumThreads(1);
  const auto alone = findCornerPeaks(image);
  cv::setNumThreads(threads);
  ASSERT_EQ(peaks.size(), alone.size());
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    EXPECT_EQ(key(peaks[i]), key(alone[i]));
    EXPECT_EQ(peaks[i].score, alone[i].score);
  }
}

TEST(CornerPeaks, NoneWithoutTextureOrRoom) {
  EXPECT_TRUE(findCornerPeaks(cv::Mat(100, 100, CV_8U, cv::Scalar(90))).empty());
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(8, 300), cv::Size(300, 8)})
    EXPECT_TRUE(findCornerPeaks(randomTexture(size, 3)).empty()) << size;
}

}  // namespace
}  // namespace mvo
