// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "mvo/se3.hpp"
#include "mvo/sim.hpp"
#include "sim/motions.hpp"
#include "sim/texture.hpp"

namespace mvo::sim {
namespace {

constexpr double kDegree = M_PI / 180;

// What a body does over a stretch of time.
struct Travel {
  double rotation = 0;     // sum of the steps' angles [rad]
  double translation = 0;  // sum of the steps' lengths [m]
  Eigen::AlignedBox3d extent;
};

Travel travelOf(const Motion& motion, double seconds) {
  constexpr double kStep = 0.05;
  Travel travel;
  for (int i = 0; i * kStep < seconds; ++i) {
    const double t = i * kStep;
    const Eigen::Isometry3d step = motion(t).inverse() * motion(t + kStep);
    travel.rotation += angle(step.linear());
    travel.translation += step.translation().norm();
    travel.extent.extend(motion(t).translation());
  }
  return travel;
}

std::string whatIsThrown(const std::string& name, const SceneOptions& options) {
  try {
    makeScene(name, 1, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Scene, UnknownNameListsTheScenes) {
  EXPECT_EQ(whatIsThrown("block", {}),
            "unknown scene \"block\", known are: blocks spin static occlusion cars street people "
            "passing twelve corridor slow");
}

TEST(Scene, BadOptionIsNamedWithItsRange) {
  SceneOptions options;
  options.blur = 1.5;
  EXPECT_EQ(whatIsThrown("blocks", options), "simulation option blur is 1.5, it must be in [0, 1]");
  options = {};
  options.rate_hz = std::nan("");
  EXPECT_NE(whatIsThrown("blocks", options).find("rate_hz"), std::string::npos);
}

TEST(Scene, HasTheBodiesItPromises) {
  EXPECT_EQ(makeScene("blocks", 1).bodies.size(), 4U);
  EXPECT_EQ(makeScene("spin", 1).bodies.size(), 1U);
  EXPECT_EQ(makeScene("static", 1).bodies.size(), 0U);
}

TEST(Scene, SeedDecidesTheMotions) {
  const Scene scene = makeScene("blocks", 5);
  const Scene same = makeScene("blocks", 5);
  const Scene other = makeScene("blocks", 6);
  EXPECT_TRUE(scene.T_world_camera(3.3).isApprox(same.T_world_camera(3.3), 0));
  EXPECT_FALSE(scene.T_world_camera(3.3).isApprox(other.T_world_camera(3.3), 1e-3));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Motion& motion = scene.bodies[i].T_world_body;
    EXPECT_TRUE(motion(3.3).isApprox(same.bodies[i].T_world_body(3.3), 0));
    EXPECT_FALSE(motion(3.3).isApprox(other.bodies[i].T_world_body(3.3), 1e-3));
  }
}

TEST(Scene, StampsAreExactMultiplesOfThePeriod) {
  Scene scene;
  scene.options.rate_hz = 15;
  EXPECT_EQ(scene.stampNs(0), 1'500'000'000'000'000'000);
  EXPECT_EQ(scene.stampNs(1), 1'500'000'000'066'666'667);
  EXPECT_EQ(scene.stampNs(300), 1'500'000'020'000'000'000);
}

TEST(Scene, CameraScalesWithTheWidth) {
  SceneOptions options;
  options.width = 1280;
  options.height = 960;
  const Scene scene = makeScene("static", 1, options);
  EXPECT_DOUBLE_EQ(scene.camera.fu, 1000);
  EXPECT_DOUBLE_EQ(scene.camera.cu, 637.2);
  EXPECT_DOUBLE_EQ(scene.camera.cv, 486.4);
  EXPECT_DOUBLE_EQ(scene.camera.baseline, 0.24);
  EXPECT_NO_THROW(scene.camera.validate());
}

// Two blocks swing, one swings and turns, one turns.
TEST(Scene, BlocksMoveAsInThePaper) {
  const Scene scene = makeScene("blocks", 3);
  const auto travel = [&](int i) { return travelOf(scene.bodies[i].T_world_body, 20); };
  for (const int swinging : {0, 2}) {
    EXPECT_GT(travel(swinging).translation, 5) << swinging;
    EXPECT_LT(travel(swinging).rotation, 12) << swinging;
  }
  EXPECT_GT(travel(1).translation, 5);
  EXPECT_GT(travel(1).rotation, 10);
  EXPECT_LT(travel(3).translation, 1);
  EXPECT_GT(travel(3).rotation, 9);
}

TEST(Scene, BoardTurnsAboutTheOpticalAxisOnly) {
  const Scene scene = makeScene("spin", 2);
  const Motion& board = scene.bodies[0].T_world_body;
  const Eigen::Isometry3d T = board(0).inverse() * board(1.0);
  EXPECT_LT(T.translation().norm(), 1e-12);
  const Eigen::AngleAxisd turn(T.linear());
  EXPECT_GT(turn.angle(), 20 * kDegree);
  // The mean optical axis is the world's x.
  EXPECT_NEAR(std::abs((board(0).linear() * turn.axis()).x()), 1, 1e-9);
  EXPECT_GT(scene.T_world_camera(0.5).linear().col(2).x(), 0.99);
}

TEST(Scene, EveryCarStopsAndGoes) {
  const Scene scene = makeScene("cars", 4);
  ASSERT_EQ(scene.bodies.size(), 3U);
  for (const Body& car : scene.bodies) {
    int resting = 0;
    int going = 0;
    for (int frame = 0; frame < 300; ++frame) {
      const Eigen::Isometry3d T =
          car.T_world_body(scene.time(frame)).inverse() * car.T_world_body(scene.time(frame + 1));
      resting += T.translation().norm() < 1e-9 ? 1 : 0;
      going += T.translation().norm() > 0.012 ? 1 : 0;
      EXPECT_LT(std::abs(T.translation().y()), 0.004) << "cars do not slide sideways";
      EXPECT_GE(T.translation().x(), -1e-9) << "cars drive forwards";
    }
    EXPECT_GT(resting, 45);
    EXPECT_GT(going, 100);
  }
}

TEST(Scene, CarsKeepApart) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = makeScene("cars", seed);
    for (int i = 0; i < 1000; ++i) {
      const double t = 0.1 * i;
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          const double distance = (scene.bodies[a].T_world_body(t).translation() -
                                   scene.bodies[b].T_world_body(t).translation())
                                      .norm();
          ASSERT_GT(distance, 0.7) << "seed " << seed << " time " << t;
        }
      }
    }
  }
}

TEST(Motions, PendulumKeepsItsLengthAndPeriod) {
  Pendulum swing;
  swing.pivot = {1, 2, 3};
  swing.length = 9.81 / (M_PI * M_PI);  // a period of 2 s
  swing.tilt = {0.2, 0};
  const Motion motion = pendulum(swing);
  for (int i = 0; i < 20; ++i) {
    const double t = 0.1 * i;
    EXPECT_NEAR((motion(t).translation() - swing.pivot).norm(), swing.length, 1e-12);
    EXPECT_TRUE(motion(t).isApprox(motion(t + 2), 1e-9));
  }
  EXPECT_NEAR(motion(0).translation().z(), 3 - swing.length, 1e-12);
  // A quarter period later it is at its turning point: 0.2 rad about world x.
  EXPECT_NEAR(motion(0.5).translation().y(), 2 + swing.length * std::sin(0.2), 1e-12);
}

TEST(Motions, StopAndGoByHand) {
  // Rides of 4 s with 1 s to start and 1 s to stop make 3 s at full speed; stops of 2 s.
  EXPECT_DOUBLE_EQ(stopAndGo(0, 4, 2, 1), 0);
  EXPECT_DOUBLE_EQ(stopAndGo(1, 4, 2, 1), 0.5);
  EXPECT_DOUBLE_EQ(stopAndGo(3, 4, 2, 1), 2.5);
  EXPECT_DOUBLE_EQ(stopAndGo(4, 4, 2, 1), 3);
  EXPECT_DOUBLE_EQ(stopAndGo(5.9, 4, 2, 1), 3);
  EXPECT_DOUBLE_EQ(stopAndGo(7, 4, 2, 1), 3.5);
  EXPECT_DOUBLE_EQ(stopAndGo(-1, 4, 2, 1), 0);  // in the stop before the first ride
}

TEST(Texture, HalvesDownToOneTexel) {
  const Texture texture = makeTexture(cv::Mat(4, 16, CV_8UC1, cv::Scalar(77)));
  ASSERT_EQ(texture.levels.size(), 5U);
  EXPECT_EQ(texture.levels[1].size(), cv::Size(8, 2));
  EXPECT_EQ(texture.levels[4].size(), cv::Size(1, 1));
  EXPECT_EQ(texture.levels[4].at<std::uint8_t>(0, 0), 77);
}

TEST(Texture, RefusesOtherSizesAndTypes) {
  EXPECT_THROW(makeTexture(cv::Mat(4, 12, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(makeTexture(cv::Mat(4, 4, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(makeTexture(cv::Mat()), std::invalid_argument);
}

}  // namespace
}  // namespace mvo::sim
