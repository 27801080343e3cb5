// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws of the stereo camera s(.).
#include "mvo/stereo_camera.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

namespace mvo {
namespace {

const StereoCamera kCamera{500, 510, 319.5, 239.5, 0.24, 640, 480};

TEST(StereoCamera, ProjectsByHand) {
  // 1 m right, 0.5 m down, 4 m ahead.
  const Eigen::Vector3d y = kCamera.project({1, 0.5, 4});
  EXPECT_DOUBLE_EQ(y.x(), 319.5 + 500 * 0.25);
  EXPECT_DOUBLE_EQ(y.y(), 239.5 + 510 * 0.125);
  EXPECT_DOUBLE_EQ(y.x() - y.z(), 500 * 0.24 / 4);
  EXPECT_DOUBLE_EQ(kCamera.rightColumn(y.x(), 4), y.z());
}

TEST(StereoCamera, BackProjectionIsTheInverse) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const double z = 10.5 + 10 * uniform(random);
    const Eigen::Vector3d p(z * uniform(random), z * uniform(random), z);
    EXPECT_LT((kCamera.backProject(kCamera.project(p)) - p).norm(), 1e-11 * p.norm());
  }
}

TEST(StereoCamera, RefusesWhatCannotBeACalibration) {
  EXPECT_NO_THROW(kCamera.validate());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto message = [](const std::function<void(StereoCamera&)>& spoil) {
    StereoCamera camera = kCamera;
    spoil(camera);
    try {
      camera.validate();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto names = [&](const std::string& word, const std::function<void(StereoCamera&)>& spoil) {
    const std::string text = message(spoil);
    EXPECT_NE(text.find(word), std::string::npos) << text;
  };
  names("image size", [](StereoCamera& c) { c.width = 0; });
  names("image size", [](StereoCamera& c) { c.height = -480; });
  names("focal", [](StereoCamera& c) { c.fu = 0; });
  names("focal", [](StereoCamera& c) { c.fv = -1; });
  names("focal", [&](StereoCamera& c) { c.fu = nan; });
  names("focal", [&](StereoCamera& c) { c.fv = infinity; });
  names("principal", [&](StereoCamera& c) { c.cu = nan; });
  names("principal", [&](StereoCamera& c) { c.cv = infinity; });
  names("baseline", [](StereoCamera& c) { c.baseline = 0; });
  names("baseline", [](StereoCamera& c) { c.baseline = -0.1; });
  names("baseline", [&](StereoCamera& c) { c.baseline = nan; });
}

}  // namespace
}  // namespace mvo
