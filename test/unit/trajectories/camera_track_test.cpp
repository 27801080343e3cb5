// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/camera_track.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

constexpr std::int64_t kPeriod = 100000000;  // [ns]

// A step forwards [m] that turns about the vertical axis [rad].
CameraStep forwards(double distance, double turn = 0, double deviation = 0) {
  CameraStep step;
  Vector6d xi = Vector6d::Zero();
  xi(2) = distance;
  xi(4) = turn;
  step.T_ckm1_ck = exp(xi);
  step.covariance(2, 2) = step.covariance(4, 4) = deviation * deviation;
  return step;
}

class Track : public testing::Test {
 protected:
  // Believes frames of steps forwards, from rest at stamp 0.
  void drive(int frames, double distance) {
    track_.say(Eigen::Isometry3d::Identity(), 0, true);
    for (int k = 1; k <= frames; ++k) add(forwards(distance), true);
  }
  void add(const CameraStep& step, bool valid) {
    stamp_ += kPeriod;
    track_.measured(step, stamp_);
    track_.say(track_.newest() * step.T_ckm1_ck, stamp_, valid);
  }
  std::string objection(const CameraStep& step) const {
    return track_.objection(step, stamp_ + kPeriod, options_);
  }
  double predicted(double seconds) const {
    return track_.predict(stamp_ + static_cast<std::int64_t>(1e9 * seconds), options_)
        .translation()
        .z();
  }

  TrajectoryOptions options_;  // 20 m/s^2: 0.2 m in 0.1 s; 100 rad/s^2: 1 rad
  CameraTrack track_;
  std::int64_t stamp_ = 0;
};

TEST_F(Track, AStepThatNeedsMoreThanAPlausibleAccelerationIsRefused) {
  drive(3, 1.0);
  EXPECT_EQ(objection(forwards(1.0)), "");
  EXPECT_EQ(objection(forwards(1.19)), "");
  EXPECT_EQ(objection(forwards(0.81, 0.99)), "");
  EXPECT_NE(objection(forwards(1.21)), "");
  EXPECT_NE(objection(forwards(1.0, 1.01)), "");
  EXPECT_EQ(
      objection(forwards(3.0)),
      "the camera cannot have moved so: 2.000 m and 0.00 deg from where its last motion leads "
      "in 0.100 s, where 0.200 m and 57.30 deg are possible");
  options_.max_acceleration = 0;
  EXPECT_EQ(objection(forwards(100)), "") << "every motion is believed";
}

TEST_F(Track, NoiseMayExplainAStep) {
  drive(3, 1.0);
  EXPECT_NE(objection(forwards(1.4)), "");
  EXPECT_EQ(objection(forwards(1.4, 0, 0.1)), "");
}

TEST_F(Track, TheFirstStepHasNothingToDepartFrom) {
  EXPECT_EQ(objection(forwards(5)), "");
  drive(0, 0);
  EXPECT_EQ(objection(forwards(5)), "");
}

// A camera at 10 m/s whose stamps come 40 ms too early or late, and one that drops frames.
TEST_F(Track, JitterOfStampsAndDroppedFramesAreNoMotion) {
  drive(3, 1.0);
  for (const double period : {0.06, 0.14, 0.06, 0.1, 0.14}) {
    const auto stamp = stamp_ + static_cast<std::int64_t>(1e9 * period);
    EXPECT_EQ(track_.objection(forwards(1.0), stamp, options_), "") << period;
    EXPECT_NE(track_.objection(forwards(3.0), stamp, options_), "") << period;
    track_.measured(forwards(1.0), stamp);
    track_.say(track_.newest() * forwards(1.0).T_ckm1_ck, stamp, true);
    stamp_ = stamp;
  }
  EXPECT_EQ(track_.objection(forwards(5.0), stamp_ + 5 * kPeriod, options_), "");
}

// A blow that is real is believed as soon as a second step says the same; a single wrong step costs
// its own frame only.
TEST_F(Track, ARefusedStepIsBelievedWhenTheNextConfirmsIt) {
  drive(3, 1.0);
  add(forwards(4.0), false);
  EXPECT_EQ(objection(forwards(4.1)), "");
  EXPECT_EQ(objection(forwards(1.1)), "");
  EXPECT_NE(objection(forwards(2.0)), "");
}

TEST_F(Track, ALostCameraGoesOnForAWhileAndThenStands) {
  drive(3, 1.0);
  EXPECT_FALSE(track_.lost());
  EXPECT_NEAR(predicted(0.1), 4.0, 1e-9);
  EXPECT_NEAR(predicted(0.5), 8.0, 1e-9);
  EXPECT_NEAR(predicted(3), 8.0, 1e-9);
  for (int k = 1; k <= 8; ++k) {  // step by step alike
    const Eigen::Isometry3d pose = track_.predict(stamp_ + kPeriod, options_);
    stamp_ += kPeriod;
    track_.say(pose, stamp_, false);
    EXPECT_NEAR(track_.newest().translation().z(), std::min(3.0 + k, 8.0), 1e-9);
    EXPECT_TRUE(track_.lost());
  }
  track_.say(track_.newest(), stamp_ += kPeriod, true);
  EXPECT_FALSE(track_.lost());
}

TEST_F(Track, ACameraThatWasNeverFoundStandsWhereItBegan) {
  EXPECT_FALSE(track_.everFound());
  track_.say(track_.predict(kPeriod, options_), kPeriod, false);
  EXPECT_FALSE(track_.everFound());
  EXPECT_NEAR(track_.newest().translation().norm(), 0, 1e-12);
}

TEST_F(Track, PosesGoOnWithoutAJump) {
  drive(3, 1.0);
  const auto continues = [this](double z, double deviation) {
    Matrix6d covariance = Matrix6d::Zero();
    covariance(2, 2) = deviation * deviation;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().z() = z;
    return track_.continues(T, forwards(1.0), stamp_ + kPeriod, covariance, options_);
  };
  EXPECT_TRUE(continues(4.19, 0));
  EXPECT_FALSE(continues(4.21, 0)) << "a correction of the frames before, not a motion";
  EXPECT_TRUE(continues(4.3, 0.04)) << "by the window's own uncertainty";
  for (int k = 0; k < 4; ++k) {
    stamp_ += kPeriod;
    track_.say(track_.newest(), stamp_, false);
  }
  EXPECT_TRUE(continues(8.9, 0)) << "lost for 0.5 s it may have got anywhere within 5 m";
  EXPECT_FALSE(continues(9.1, 0));
}

}  // namespace
}  // namespace mvo
