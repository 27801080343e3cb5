// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/depth_association.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 60, 40, 0.1, 120, 80};

cv::Mat constantDepth(float z) { return {80, 120, CV_32F, cv::Scalar(z)}; }

TEST(DepthAssociation, ExactOnASlantedPlane) {
  // n . p = 1 with p = z (x, y, 1): 1 / z is linear over the image.
  const Eigen::Vector3d n(0.2, -0.1, 0.5);
  const auto inverseDepth = [&n](double u, double v) {
    return n.dot(Eigen::Vector3d((u - kCamera.cu) / kCamera.fu, (v - kCamera.cv) / kCamera.fv, 1));
  };
  cv::Mat depth(80, 120, CV_32F);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      depth.at<float>(v, u) = static_cast<float>(1 / inverseDepth(u, v));
  for (const cv::Point2f p : {cv::Point2f(0, 0), cv::Point2f(30.25F, 17.75F),
                              cv::Point2f(60.5F, 40), cv::Point2f(118.9F, 78.9F)}) {
    const auto u_r = virtualRightColumn(depth, p, kCamera, {});
    ASSERT_TRUE(u_r) << p;
    const double truth = p.x - kCamera.fu * kCamera.baseline * inverseDepth(p.x, p.y);
    EXPECT_NEAR(*u_r, truth, 1e-4) << p;
  }
}

TEST(DepthAssociation, NoneOverHoles) {
  for (const float hole : {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(), 0.0F, -1.0F}) {
    cv::Mat depth = constantDepth(2);
    depth.at<float>(20, 30) = hole;
    for (const cv::Point2f p : {cv::Point2f(30, 20), cv::Point2f(29.5F, 19.5F)})
      EXPECT_FALSE(virtualRightColumn(depth, p, kCamera, {})) << hole << p;
    EXPECT_TRUE(virtualRightColumn(depth, {31, 20}, kCamera, {})) << hole;
  }
}

TEST(DepthAssociation, NoneOutsideTheRange) {
  FrontendOptions options;
  options.min_depth = 0.5;
  options.max_depth = 4;
  for (const float z : {0.49F, 4.01F})
    EXPECT_FALSE(virtualRightColumn(constantDepth(z), {30, 20}, kCamera, options)) << z;
  for (const float z : {0.5F, 4.0F})
    EXPECT_TRUE(virtualRightColumn(constantDepth(z), {30, 20}, kCamera, options)) << z;
}

TEST(DepthAssociation, NoneAcrossEdges) {
  cv::Mat depth = constantDepth(3);
  depth.colRange(0, 50).setTo(1.0F);
  EXPECT_FALSE(virtualRightColumn(depth, {49.5F, 20.5F}, kCamera, {}));
  EXPECT_NEAR(virtualRightColumn(depth, {48.9F, 20}, kCamera, {}).value(), 48.9 - 50, 1e-4);
}

TEST(DepthAssociation, NoneWhereThePatchShowsANearerSurface) {
  const FrontendOptions options;  // a patch reaches 6 px to each side
  cv::Mat depth = constantDepth(3);
  depth.colRange(40, 41).setTo(1.5F);  // a string
  for (const float u : {34.0F, 37.0F, 43.0F, 46.0F})
    EXPECT_FALSE(virtualRightColumn(depth, {u, 20}, kCamera, options)) << u;
  for (const float u : {33.0F, 47.0F})
    EXPECT_TRUE(virtualRightColumn(depth, {u, 20}, kCamera, options)) << u;
  depth = constantDepth(3);
  depth.colRange(0, 40).setTo(1.5F);  // a body: its own outline belongs to it
  EXPECT_TRUE(virtualRightColumn(depth, {37, 20}, kCamera, options));
  EXPECT_FALSE(virtualRightColumn(depth, {42, 20}, kCamera, options));
}

TEST(DepthAssociation, NoneOutsideTheImage) {
  const cv::Mat depth = constantDepth(2);
  for (const cv::Point2f p : {cv::Point2f(-0.1F, 20), cv::Point2f(20, -0.1F), cv::Point2f(119, 20),
                              cv::Point2f(20, 79), cv::Point2f(5000, 20)})
    EXPECT_FALSE(virtualRightColumn(depth, p, kCamera, {})) << p;
}

}  // namespace
}  // namespace mvo
