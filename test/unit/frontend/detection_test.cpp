// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;

const cv::Size kSize(640, 480);

long countIn(const std::vector<cv::Point2f>& points, const cv::Rect2f& region) {
  return std::count_if(points.begin(), points.end(),
                       [&region](const cv::Point2f& p) { return region.contains(p); });
}

std::vector<cv::Point2f> detectIn(const cv::Mat& image, const std::vector<Feature>& known,
                                  const TrackingPrior& prior, const FrontendOptions& options) {
  return detectCorners(findCornerPeaks(image), image.size(), known, prior, options);
}

Feature featureAt(TrackletId id, double u, double v) { return {id, {u, v, u - 10}}; }

TEST(Detection, SpreadsPointsOverTheImage) {
  FrontendOptions options;
  options.max_features = 300;
  const auto points = detectIn(randomTexture(kSize, 1), {}, {}, options);
  ASSERT_EQ(points.size(), 300U);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_GE(countIn(points, cv::Rect2f(column * 160.0F, row * 160.0F, 160, 160)), 15)
          << column << ", " << row;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GT(cv::norm(points[i] - points[j]), options.spacing - 1);
}

TEST(Detection, KeepsAwayFromKnownPoints) {
  const std::vector<Feature> known{featureAt(3, 320, 240), featureAt(5, 100, 100)};
  const auto points = detectIn(randomTexture(kSize, 2), known, {}, {});
  ASSERT_GT(points.size(), 100U);
  for (const cv::Point2f& p : points) {
    EXPECT_GT(cv::norm(p - cv::Point2f(320, 240)), 15);
    EXPECT_GT(cv::norm(p - cv::Point2f(100, 100)), 15);
  }
}

TEST(Detection, WeakTextureIsNotStarvedByStrongTexture) {
  cv::Mat image(kSize, CV_8U);
  randomTexture({320, 480}, 3, 120).copyTo(image.colRange(0, 320));
  randomTexture({320, 480}, 4, 20).copyTo(image.colRange(320, 640));
  FrontendOptions options;
  options.max_features = 200;
  const auto points = detectIn(image, {}, {}, options);
  ASSERT_EQ(points.size(), 200U);
  EXPECT_GE(countIn(points, cv::Rect2f(330, 0, 310, 480)), 70);
}

TEST(Detection, MovingBodiesGetMorePoints) {
  const cv::Mat image = randomTexture(kSize, 5);
  const cv::Rect2f body(300, 200, 50, 50);
  std::vector<Feature> known;
  TrackingPrior prior;
  for (const auto& [u, v] : {std::make_pair(312, 212), {338, 212}, {312, 238}, {338, 238}}) {
    known.push_back(featureAt(static_cast<TrackletId>(known.size()), u, v));
    prior.dense[known.back().id] = true;
  }
  const auto sparse = detectIn(image, known, {}, {});
  const auto dense = detectIn(image, known, prior, {});
  EXPECT_GE(countIn(dense, body) + 4, 14);
  EXPECT_GE(countIn(dense, body), countIn(sparse, body) + 5);
}

TEST(Detection, MovingBodiesWaitForNoTurnWhenRoomIsScarce) {
  const cv::Mat image = randomTexture(kSize, 6);
  const std::vector<Feature> known{featureAt(0, 320, 240)};
  TrackingPrior prior;
  prior.dense[0] = true;
  FrontendOptions options;
  options.max_features = 100;  // less than one per region and the body's
  const cv::Rect2f body(286, 206, 68, 68);
  const auto fair = detectIn(image, known, {}, options);
  const auto points = detectIn(image, known, prior, options);
  EXPECT_GE(countIn(points, body), 8);
  EXPECT_GE(countIn(points, body), countIn(fair, body) + 5);
  EXPECT_GE(static_cast<int>(points.size()) - countIn(points, body), 40)
      << "others have their share";
}

TEST(Detection, DimImagesHaveAboutAsManyPointsAsBrightOnes) {
  FrontendOptions options;
  options.max_features = 2000;
  const cv::Mat bright = randomTexture(kSize, 8);
  const auto wanted = static_cast<double>(detectIn(bright, {}, {}, options).size());
  for (const double gain : {0.3, 0.05}) {
    cv::Mat dim;
    bright.convertTo(dim, CV_8U, gain);
    EXPECT_GT(static_cast<double>(detectIn(dim, {}, {}, options).size()), 0.8 * wanted) << gain;
  }
}

TEST(Detection, WeakCornersAreNoneWhereStrongOnesAre) {
  cv::Mat image(kSize, CV_8U);
  randomTexture({320, 480}, 9, 120).copyTo(image.colRange(0, 320));
  randomTexture({320, 480}, 10, 6).copyTo(image.colRange(320, 640));
  EXPECT_EQ(countIn(detectIn(image, {}, {}, {}), cv::Rect2f(330, 0, 310, 480)), 0);
}

TEST(Detection, NeverMoreThanTheLimit) {
  const cv::Mat image = randomTexture(kSize, 7);
  FrontendOptions options;
  options.max_features = 50;
  EXPECT_EQ(detectIn(image, {}, {}, options).size(), 50U);
  std::vector<Feature> known;
  for (int i = 0; i < 47; ++i) known.push_back(featureAt(i, 20, 20));
  EXPECT_EQ(detectIn(image, known, {}, options).size(), 3U);
  for (int i = 0; i < 10; ++i) known.push_back(featureAt(50 + i, 20, 20));
  EXPECT_TRUE(detectIn(image, known, {}, options).empty());
}

TEST(Detection, SpacingScalesWithTheImage) {
  const FrontendOptions options;
  EXPECT_DOUBLE_EQ(spacingIn({640, 480}, options), options.spacing);
  EXPECT_DOUBLE_EQ(spacingIn({1280, 960}, options), 2 * options.spacing);
}

TEST(Detection, NothingWithoutContrast) {
  for (const int grey : {0, 128, 255})
    EXPECT_TRUE(detectIn(cv::Mat(kSize, CV_8U, cv::Scalar(grey)), {}, {}, {}).empty());
  cv::Mat edge(kSize, CV_8U, cv::Scalar(20));
  edge.colRange(320, 640).setTo(220);
  EXPECT_TRUE(detectIn(edge, {}, {}, {}).empty()) << "an edge is no corner";
  cv::Mat hardly(kSize, CV_8U, cv::Scalar(100));
  hardly(cv::Rect(300, 200, 40, 40)).setTo(101);
  EXPECT_TRUE(detectIn(hardly, {}, {}, {}).empty());
  hardly(cv::Rect(300, 200, 40, 40)).setTo(140);
  EXPECT_EQ(detectIn(hardly, {}, {}, {}).size(), 4U) << "the corners of a square";
}

TEST(Detection, KnownPointsOutsideTheImageDoNoHarm) {
  const std::vector<Feature> known{featureAt(1, -50, 1000), featureAt(2, 5000, -3)};
  TrackingPrior prior;
  prior.dense[1] = true;
  EXPECT_GT(detectIn(randomTexture(kSize, 8), known, prior, {}).size(), 100U);
}

}  // namespace
}  // namespace mvo
