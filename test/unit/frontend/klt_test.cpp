// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Links on texture that repeats itself.
#include "frontend/klt.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "frontend/patch_flow.hpp"
#include "support/textures.hpp"

namespace mvo {
namespace {

using test_support::randomTexture;
using test_support::translated;

constexpr int kPeriod = 14;
constexpr int kShift = 9;  // to the right: more than half a period
const cv::Size kSize(400, 320);
const cv::Rect kFence(0, 100, 400, 120);  // repeats itself along u
const StereoCamera kCamera{400, 400, 200, 160, 0.05, kSize.width, kSize.height};

// Pickets that are alike, with knots at heights of their own, before a unique texture.
cv::Mat fenceBeforeTexture() {
  cv::Mat image = randomTexture(kSize, 1);
  const cv::Mat knots = randomTexture({1, kFence.height}, 2, 60);
  for (int v = 0; v < kFence.height; ++v)
    for (int u = 0; u < kFence.width; ++u)
      image.at<uchar>(kFence.y + v, u) =
          cv::saturate_cast<uchar>(knots.at<uchar>(v, 0) + 60 * std::cos(2 * CV_PI * u / kPeriod));
  return image;
}

FrameImages rgbdImages(const cv::Mat& grey) {
  FrameImages images;
  images.left = buildPyramid(grey, FrontendOptions());
  images.depth = cv::Mat(grey.size(), CV_32F, cv::Scalar(2));
  return images;
}

std::vector<Feature> featuresIn(const cv::Rect& part) {
  std::vector<Feature> features;
  for (int v = part.y + 30; v < part.br().y - 30; v += 12)
    for (int u = part.x + 60; u < part.br().x - 60; u += 12) {
      Feature f;
      f.id = 1000 * v + u;
      f.y = {static_cast<double>(u), static_cast<double>(v), kCamera.rightColumn(u, 2)};
      f.v_right = v;
      features.push_back(f);
    }
  return features;
}

struct Count {
  int right = 0;
  int wrong = 0;
};

// Of the points that see nothing but the fence: how many are found where the image has moved to,
// and elsewhere.
Count countOnFence(const std::vector<Feature>& links) {
  Count count;
  for (const Feature& f : links) {
    const auto v = static_cast<int>(f.id / 1000);
    if (v < kFence.y + 10 || v >= kFence.br().y - 10) continue;
    const double error = f.y.x() - static_cast<double>(f.id % 1000) - kShift;
    ++(std::abs(error) < 0.5 ? count.right : count.wrong);
  }
  return count;
}

class LinksOnAFence : public testing::Test {
 protected:
  std::vector<Feature> follow(const std::vector<Feature>& features, const TrackingPrior& prior) {
    options_.pyramid_levels = 1;  // coarser ones see what surrounds the fence
    return closeCircle(rgbdImages(before_), rgbdImages(after_), features, prior, kCamera, options_);
  }

  cv::Mat before_ = fenceBeforeTexture();
  cv::Mat after_ = translated(before_, kShift, 0);
  FrontendOptions options_;
  std::vector<Feature> fence_ = featuresIn(kFence);
  std::vector<Feature> everywhere_ = featuresIn({0, 0, kSize.width, kSize.height});
};

TEST_F(LinksOnAFence, AreAPeriodOffWhenNothingTellsOtherwise) {
  const Count count = countOnFence(follow(fence_, {}));
  EXPECT_GT(count.wrong, 0.5 * static_cast<double>(fence_.size()));
}

TEST_F(LinksOnAFence, AreRightAsWhatSurroundsItTells) {
  const Count count = countOnFence(follow(everywhere_, {}));
  EXPECT_EQ(count.wrong, 0);
  EXPECT_GT(count.right, 0.9 * static_cast<double>(fence_.size()));
}

TEST_F(LinksOnAFence, AreAPeriodOffWithoutASecondLook) {
  options_.second_look = false;
  const Count count = countOnFence(follow(everywhere_, {}));
  EXPECT_GT(count.wrong, 0.5 * static_cast<double>(fence_.size()));
}

TEST_F(LinksOnAFence, AreRightIfPredicted) {
  TrackingPrior prior;
  for (const Feature& f : fence_) prior.predicted[f.id] = f.y + Eigen::Vector3d(7, 1, 7);
  const Count count = countOnFence(follow(fence_, prior));
  EXPECT_EQ(count.wrong, 0);
  EXPECT_GT(count.right, 0.95 * static_cast<double>(fence_.size()));
}

TEST_F(LinksOnAFence, AreTheSameFromAnyNumberOfThreads) {
  cv::setNumThreads(1);
  const auto one = follow(everywhere_, {});
  cv::setNumThreads(3);
  const auto three = follow(everywhere_, {});
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].y, three[i].y);
}

TEST(Links, OfAUniqueTextureAreAllKept) {
  const cv::Mat before = randomTexture(kSize, 1);
  std::vector<Feature> features = featuresIn({0, 0, kSize.width, kSize.height});
  for (const int shift : {0, 3, kShift}) {
    cv::Mat noise(kSize, CV_8S);
    cv::RNG(5).fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::Mat after;
    cv::add(translated(before, shift, 0), noise, after, {}, CV_8U);
    const auto links =
        closeCircle(rgbdImages(before), rgbdImages(after), features, {}, kCamera, {});
    EXPECT_EQ(links.size(), features.size()) << shift;
  }
}

// Some points move as a body of their own, whatever the others do.
TEST(Links, OfAnotherMotionAreKept) {
  const cv::Mat before = randomTexture(kSize, 1);
  const cv::Rect body(100, 100, 200, 120);
  cv::Mat after = before.clone();
  translated(before, 5, 2)(body).copyTo(after(body));
  const std::vector<Feature> features = featuresIn(body);
  const auto links = closeCircle(rgbdImages(before), rgbdImages(after),
                                 featuresIn({0, 0, kSize.width, kSize.height}), {}, kCamera, {});
  std::size_t moved = 0;
  for (const Feature& f : links) {
    const TrackletId u = f.id % 1000;
    const TrackletId v = f.id / 1000;
    const Eigen::Vector2d place(static_cast<double>(u) + 5, static_cast<double>(v) + 2);
    if ((f.y.head<2>() - place).norm() < 0.3) ++moved;
  }
  EXPECT_GE(moved, features.size() * 9 / 10);
}

}  // namespace
}  // namespace mvo
