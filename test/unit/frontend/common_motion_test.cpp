// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/common_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 320, 240, 0.2, 640, 480};

// Points in a part of the image, 2 to 6 m away, each moved by a transform.
std::vector<FoundPoint> pointsIn(const cv::Rect2d& part, const Eigen::Isometry3d& T, int count) {
  cv::RNG random(7);
  std::vector<FoundPoint> points;
  for (int i = 0; i < count; ++i) {
    const double u = part.x + random.uniform(0.0, part.width);
    const double v = part.y + random.uniform(0.0, part.height);
    const Eigen::Vector3d y(u, v, kCamera.rightColumn(u, random.uniform(2.0, 6.0)));
    points.push_back({y, kCamera.project(T * kCamera.backProject(y)).head<2>()});
  }
  return points;
}

Eigen::Isometry3d smallMotion() {
  Vector6d twist;
  twist << 0.01, -0.02, 0.015, 0.006, -0.008, 0.004;
  return exp(twist);
}

TEST(CommonMotion, TellsWhereAnotherPointIs) {
  const auto points = pointsIn({0, 0, 640, 480}, smallMotion(), 60);
  const auto motion = CommonMotion::fit(points, kCamera);
  ASSERT_TRUE(motion);
  for (const FoundPoint& p : pointsIn({100, 100, 400, 300}, smallMotion(), 20)) {
    EXPECT_GT((p.expected.head<2>() - p.found).norm(), 1.5);
    EXPECT_LT((motion->place(p.expected, kCamera).uv - p.found).norm(), 0.1);
  }
}

TEST(CommonMotion, DoesNotFollowTheFew) {
  auto points = pointsIn({0, 0, 640, 480}, smallMotion(), 60);
  for (std::size_t i = 0; i < points.size(); i += 3) points[i].found += Eigen::Vector2d(14, -6);
  const auto motion = CommonMotion::fit(points, kCamera);
  ASSERT_TRUE(motion);
  for (std::size_t i = 1; i < points.size(); i += 3)
    EXPECT_LT((motion->place(points[i].expected, kCamera).uv - points[i].found).norm(), 0.2);
}

TEST(CommonMotion, IsLessCertainFarFromItsPoints) {
  const auto motion = CommonMotion::fit(pointsIn({40, 40, 60, 60}, smallMotion(), 20), kCamera);
  ASSERT_TRUE(motion);
  const auto variance = [&](double u, double v) {
    return motion->place({u, v, kCamera.rightColumn(u, 3)}, kCamera).covariance.trace();
  };
  EXPECT_GT(variance(600, 440), 20 * variance(70, 70));
}

TEST(CommonMotion, IsAsUncertainAsItsPointsDisagree) {
  auto points = pointsIn({0, 0, 640, 480}, smallMotion(), 200);
  cv::RNG random(3);
  for (FoundPoint& p : points)
    p.found += Eigen::Vector2d(random.gaussian(0.7), random.gaussian(0.7));
  const auto motion = CommonMotion::fit(points, kCamera);
  ASSERT_TRUE(motion);
  const ExpectedPlace place = motion->place(points.front().expected, kCamera);
  EXPECT_NEAR(std::sqrt(0.5 * place.covariance.trace()), 0.7, 0.15);
}

TEST(CommonMotion, NeedsEightPoints) {
  const auto points = pointsIn({0, 0, 640, 480}, smallMotion(), 8);
  EXPECT_TRUE(CommonMotion::fit(points, kCamera));
  EXPECT_FALSE(CommonMotion::fit({points.begin(), points.end() - 1}, kCamera));
  EXPECT_FALSE(CommonMotion::fit({}, kCamera));
}

}  // namespace
}  // namespace mvo
