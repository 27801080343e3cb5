// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A jerky camera before random points, read out row by row, against the same views taken at once.
#include "frontend/camera/rolling_shutter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

constexpr double kPeriod = 1.0 / 30;
const StereoCamera kCamera{600, 600, 320, 240, 0.05, 640, 480};

struct Shot {
  double readout = 0;        // [s]
  double noise = 0;          // of u, v and the disparity [px]
  bool moving = true;        // or at rest
  bool sensed_depth = true;  // a depth image, taken at once
  int frames = 40;
  int points = 120;
};

// T_camera_world at a time [s].
Eigen::Isometry3d cameraAt(double t, bool moving) {
  if (!moving) return Eigen::Isometry3d::Identity();
  Vector6d xi;
  xi << 0.05 * std::sin(7 * t), 0.04 * std::sin(9 * t), 0.05 * std::sin(4 * t),
      0.06 * std::sin(8 * t), 0.08 * std::sin(6 * t + 1), 0.05 * std::sin(5 * t);
  return exp(xi);
}

struct Recording {
  Window seen;
  Window truth;
  Trajectory world;
  std::vector<int> support;
  FrameTimes times;
};

Recording record(const Shot& shot) {
  Recording r;
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::normal_distribution<double> normal;
  r.seen.last_frame = r.truth.last_frame = shot.frames - 1;
  for (int k = 0; k < shot.frames; ++k) {
    r.times[k] = kPeriod * k;
    r.world.T_ck_c1.push_back(cameraAt(kPeriod * k, shot.moving) *
                              cameraAt(0, shot.moving).inverse());
    r.world.segment.push_back(0);
  }
  for (int p = 0; p < shot.points; ++p) {
    const double z = uniform(0.5, 3);
    const Eigen::Vector3d p_world(uniform(-0.45, 0.45) * z, uniform(-0.35, 0.35) * z, z);
    Tracklet seen;
    Tracklet truth;
    seen.id = truth.id = p;
    for (int k = 0; k < shot.frames; ++k) {
      const auto view = [&](double t) {
        return kCamera.project(cameraAt(t, shot.moving) * p_world);
      };
      const Eigen::Vector3d at_once = view(kPeriod * k);
      Eigen::Vector3d y = at_once;
      for (int i = 0; i < 10; ++i)  // the row says when, which says the row
        y = view(kPeriod * k + shot.readout * (y.y() / kCamera.height - 0.5));
      if (shot.sensed_depth) y.z() = y.x() - (at_once.x() - at_once.z());
      for (int i = 0; i < 3; ++i) y(i) += shot.noise * normal(random);
      seen.observations.push_back({k, y});
      truth.observations.push_back({k, at_once});
    }
    r.seen.tracklets.push_back(seen);
    r.truth.tracklets.push_back(truth);
    r.support.push_back(p);
  }
  return r;
}

// Root mean square distance of u and v from the truth, of frames [first, last].
double imageError(const Window& window, const Window& truth, FrameId first, FrameId last) {
  double sum = 0;
  int n = 0;
  for (std::size_t p = 0; p < truth.tracklets.size(); ++p)
    for (FrameId k = first; k <= last; ++k, ++n)
      sum +=
          (window.tracklets[p].find(k)->y - truth.tracklets[p].find(k)->y).head<2>().squaredNorm();
  return std::sqrt(sum / n);
}

// The readout found after all frames have come one by one.
double learnt(const Shot& shot, Shutter mode) {
  const Recording r = record(shot);
  Options options;
  options.frontend.shutter = mode;
  options.frontend.readout = 0.02;
  const LinkResidual residual(kCamera, options.noise, ResidualModel::kWhitened);
  RollingShutter shutter;
  for (int k = 0; k < shot.frames; ++k) {
    shutter.addFrame(k, r.times.at(k), shot.sensed_depth, options.window.frames);
    Window so_far = r.seen;
    so_far.last_frame = k;
    for (Tracklet& t : so_far.tracklets) t.observations.resize(k + 1);
    Trajectory world = r.world;
    world.T_ck_c1.resize(k + 1);
    world.segment.resize(k + 1);
    shutter.learn(so_far, world, r.support, residual, options.energy.threshold, options.frontend);
  }
  return shutter.readout(options.frontend);
}

TEST(RollingShutter, ObservationsAreSetBackToTheirFramesTime) {
  Shot shot;
  shot.readout = 0.9 * kPeriod;
  for (const bool sensed_depth : {true, false}) {
    shot.sensed_depth = sensed_depth;
    const Recording r = record(shot);
    const Window window = withGlobalShutter(r.seen, r.times, kCamera, shot.readout, sensed_depth);
    EXPECT_GT(imageError(r.seen, r.truth, 1, 38), 2.0);
    EXPECT_LT(imageError(window, r.truth, 1, 38), 0.1);
    EXPECT_LT(imageError(window, r.truth, 39, 39), 1.0) << "the newest has no frame after it";
    for (std::size_t p = 0; p < window.tracklets.size(); ++p) {
      const Eigen::Vector3d y = window.tracklets[p].observations[20].y;
      const Eigen::Vector3d truth = r.truth.tracklets[p].observations[20].y;
      EXPECT_NEAR(y.x() - y.z(), truth.x() - truth.z(), 0.02);
    }
  }
}

TEST(RollingShutter, AGlobalShutterChangesNothing) {
  const Recording r = record({});
  const Window window = withGlobalShutter(r.seen, r.times, kCamera, 0, false);
  for (std::size_t p = 0; p < window.tracklets.size(); ++p)
    for (std::size_t j = 0; j < window.tracklets[p].observations.size(); ++j)
      EXPECT_LT((window.tracklets[p].observations[j].y - r.seen.tracklets[p].observations[j].y)
                    .cwiseAbs()
                    .maxCoeff(),
                1e-9);
}

TEST(RollingShutter, TheReadoutIsFound) {
  for (const double readout : {0.9 * kPeriod, 0.5 * kPeriod, -0.7 * kPeriod}) {
    Shot shot;
    shot.readout = readout;
    shot.noise = 0.1;
    EXPECT_NEAR(learnt(shot, Shutter::kAuto), readout, 0.05 * kPeriod);
    shot.sensed_depth = false;
    EXPECT_NEAR(learnt(shot, Shutter::kAuto), readout, 0.05 * kPeriod);
  }
}

TEST(RollingShutter, GlobalShuttersAndCamerasAtRestHaveNone) {
  Shot shot;
  shot.noise = 0.2;
  EXPECT_EQ(learnt(shot, Shutter::kAuto), 0);
  shot.moving = false;
  EXPECT_EQ(learnt(shot, Shutter::kAuto), 0);
  shot.readout = kPeriod;
  EXPECT_EQ(learnt(shot, Shutter::kAuto), 0);
}

TEST(RollingShutter, WhatIsGivenIsTaken) {
  Shot shot;
  shot.readout = kPeriod;
  EXPECT_EQ(learnt(shot, Shutter::kGlobal), 0);
  EXPECT_EQ(learnt(shot, Shutter::kRolling), 0.02);
}

}  // namespace
}  // namespace mvo
