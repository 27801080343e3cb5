// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The scenes that are hard for their content hold what their summaries promise, for any seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "mvo/se3.hpp"
#include "mvo/sim.hpp"
#include "sim/circuit.hpp"

namespace mvo::sim {
namespace {

constexpr double kDegree = M_PI / 180;

// A body's largest share of the image over some frames.
double largestShare(const Scene& scene, std::size_t body, int frames, int step) {
  double largest = 0;
  for (int k = 0; k < frames; k += step)
    largest = std::max(largest, render(scene, k).objects.at(body).image_share);
  return largest;
}

SceneOptions quarter(const std::string& name) {
  SceneOptions options = usualOptions(name);
  options.width /= 4;
  options.height /= 4;
  return options;
}

TEST(Street, IsSeenByAUsualCarsCamera) {
  const Scene scene = makeScene("street", 1);
  EXPECT_EQ(scene.options.width, 1241);
  EXPECT_EQ(scene.options.height, 376);
  EXPECT_DOUBLE_EQ(scene.options.rate_hz, 10);
  EXPECT_DOUBLE_EQ(scene.camera.fu, 718.9);
  EXPECT_DOUBLE_EQ(scene.camera.cu, 607.2);
  EXPECT_DOUBLE_EQ(scene.camera.cv, 185.2);
  EXPECT_DOUBLE_EQ(scene.camera.baseline, 0.537);
}

TEST(Street, BendsAndNeverEnds) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = makeScene("street", seed, quarter("street"));
    double turned = 0;
    for (int k = 0; k < 900; ++k) {  // more than a lap
      const Eigen::Isometry3d step =
          scene.T_world_camera(scene.time(k)).inverse() * scene.T_world_camera(scene.time(k + 1));
      EXPECT_GT(step.translation().z(), 0.8) << "drives forwards";
      EXPECT_LT(step.translation().z(), 1.2);
      EXPECT_LT(std::abs(step.translation().x()), 0.1) << "not sideways";
      EXPECT_LT(angle(step.linear()), 4 * kDegree);
      if (k < 100) turned += std::abs(std::asin(step.linear()(0, 2)));
    }
    EXPECT_GT(turned, 20 * kDegree) << "within the first 100 frames";
  }
}

TEST(Street, TrafficIsSeenAndMoves) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Scene scene = makeScene("street", seed, quarter("street"));
    ASSERT_EQ(scene.bodies.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_GT(largestShare(scene, i, 100, 2), 0.01) << "seed " << seed << " car " << i + 1;
      for (int k = 0; k < 100; ++k) {
        const Eigen::Isometry3d step = scene.bodies[i].T_world_body(scene.time(k)).inverse() *
                                       scene.bodies[i].T_world_body(scene.time(k + 1));
        EXPECT_GT(step.translation().x(), 0.3) << "forwards";
        EXPECT_LT(std::abs(step.translation().y()), 0.1) << "not sideways";
      }
    }
  }
}

TEST(Circuit, IsParametrizedByItsLength) {
  const Circuit circuit(90, {{2, 0.08, 0.3}, {5, 0.03, 1.1}});
  EXPECT_TRUE(circuit.pose(circuit.length() + 7, 1).isApprox(circuit.pose(7, 1), 1e-9));
  EXPECT_TRUE(circuit.pose(-7, 1).isApprox(circuit.pose(circuit.length() - 7, 1), 1e-9));
  for (int k = 0; k < 160; ++k) {
    const double way = 3.7 * k - 5;
    const Eigen::Isometry3d T = circuit.pose(way, 0);
    const Eigen::Vector3d step = T.inverse() * circuit.pose(way + 1e-3, 0).translation();
    EXPECT_NEAR(step.x(), 1e-3, 1e-7);
    EXPECT_NEAR(step.y(), 0, 1e-6);
    EXPECT_NEAR((T.inverse() * circuit.pose(way, 2).translation()).y(), 2, 1e-9);
  }
}

TEST(People, WalkOnLegsThatSwing) {
  const Scene scene = makeScene("people", 4, quarter("people"));
  ASSERT_EQ(scene.bodies.size(), 3U);
  EXPECT_TRUE(scene.bodies[0].limbs.empty()) << "the cart is rigid";
  for (const std::size_t person : {1, 2}) {
    const Body& body = scene.bodies[person];
    ASSERT_EQ(body.limbs.size(), 6U);
    double low = 0;
    double high = 0;
    double deepest = 1;
    for (int k = 0; k < 240; ++k) {
      const double t = 0.05 * k;
      const Eigen::Isometry3d T_body_thigh = body.limbs[0].T_body_limb(t);
      const double forward = (T_body_thigh.linear() * -Eigen::Vector3d::UnitZ()).x();
      low = std::min(low, forward);
      high = std::max(high, forward);
      for (const Limb& limb : body.limbs)
        for (const Face& face : limb.faces)
          for (const Eigen::Vector3d& corner : face.corners)
            deepest =
                std::min(deepest, (body.T_world_body(t) * (limb.T_body_limb(t) * corner)).z());
    }
    EXPECT_LT(low, -0.35);
    EXPECT_GT(high, 0.35);
    EXPECT_GT(deepest, -0.1) << "feet stay above the floor";
    EXPECT_LT(deepest, 0.05) << "and reach it";
    EXPECT_GT(largestShare(scene, person, 60, 4), 0.03);
  }
}

TEST(Passing, CoversTwoThirdsAndLeaves) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Scene scene = makeScene("passing", seed, quarter("passing"));
    double largest = 0;
    double smallest = 1;
    for (int k = 0; k < 150; k += 2) {
      const double share = render(scene, k).objects.at(0).image_share;
      largest = std::max(largest, share);
      smallest = std::min(smallest, share);
    }
    EXPECT_GT(largest, 0.6) << seed;
    EXPECT_LT(largest, 0.85) << seed;
    EXPECT_EQ(smallest, 0) << seed;
  }
}

TEST(Twelve, AreSmallAndSeen) {
  const Scene scene = makeScene("twelve", 2);
  ASSERT_EQ(scene.bodies.size(), 12U);
  for (const int k : {0, 60}) {
    for (const BodyVisibility& object : render(scene, k).objects) {
      EXPECT_GT(std::sqrt(object.silhouette_px), 45) << object.body;
      EXPECT_LT(std::sqrt(object.silhouette_px), 68) << object.body;
      EXPECT_GT(object.visible_share, 0.6) << object.body;
    }
  }
}

TEST(Corridor, HasFewCorners) {
  const auto corners = [](const std::string& name) {
    SceneOptions options;
    options.noise = 0;
    std::vector<cv::Point2f> points;
    const RenderedFrame frame = render(makeScene(name, 3, options), 40);
    cv::Mat contrast;
    cv::cornerMinEigenVal(frame.left, contrast, 5, 3);
    return cv::countNonZero(contrast > 1e-3) / static_cast<double>(contrast.total());
  };
  EXPECT_LT(corners("corridor"), 0.25 * corners("blocks"));
}

TEST(Slow, BodiesMoveByAFractionOfAPixel) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = makeScene("slow", seed, quarter("slow"));
    ASSERT_EQ(scene.bodies.size(), 5U);
    for (const Body& body : scene.bodies) {
      for (int k = 0; k < 300; k += 10) {
        const Eigen::Vector3d now = body.T_world_body(scene.time(k)).translation();
        const Eigen::Vector3d next = body.T_world_body(scene.time(k + 1)).translation();
        const double front = now.x() - 0.25 + 0.1;  // from the camera [m]
        const double pixels = 500 * (next - now).norm() / front;
        EXPECT_GT(pixels, 0.17);
        EXPECT_LT(pixels, 1.05);
      }
    }
  }
}

}  // namespace
}  // namespace mvo::sim
