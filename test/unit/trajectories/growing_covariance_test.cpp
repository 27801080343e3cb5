// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What leaves the window's sight stays uncertain, and what goes on by rule becomes so.
#include "trajectories/growing_covariance.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mvo/se3.hpp"
#include "trajectories/prediction_errors.hpp"

namespace mvo {
namespace {

Trajectory trajectoryOf(FrameId first, int frames, const Vector6d& twist) {
  Trajectory trajectory;
  trajectory.first_frame = first;
  trajectory.append(std::nullopt);
  for (int i = 1; i < frames; ++i) trajectory.append(exp(twist));
  return trajectory;
}

Vector6d ones() { return Vector6d::Ones(); }

TEST(GrowingCovariance, GrowsByTheShareOfEachFrameThatLeaves) {
  GrowingCovariance covariance;
  const Matrix6d S = Vector6d(1e-6 * ones()).asDiagonal();
  for (FrameId first = 0; first <= 30; ++first) {
    covariance.update(trajectoryOf(first, 11, Vector6d::Zero()), S);
    const double grown = 1 + 0.1 * static_cast<double>(first);
    EXPECT_LT((covariance.newest() - grown * S).norm(), 1e-9 * S.norm()) << first;
  }
}

// Errors of steps that are independent add up to what is said of them, within a factor that the
// law's simplicity costs.
TEST(GrowingCovariance, IsThatOfARandomWalk) {
  constexpr int kRuns = 300;
  constexpr int kFrames = 120;
  constexpr int kWindow = 12;
  const double sd = 1e-3;
  Vector6d twist = Vector6d::Zero();
  twist(2) = 0.05;
  twist(4) = 0.02;
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, sd);
  const auto steps = [&](int count, const auto& noise) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (int i = 0; i < count; ++i) T = exp(noise()) * exp(twist) * T;
    return T;
  };
  const auto noisy = [&] {
    Vector6d n;
    for (double& x : n) x = normal(generator);
    return n;
  };
  const auto none = [] { return Vector6d(Vector6d::Zero()); };
  Matrix6d S = Matrix6d::Zero();  // of a window
  for (int i = 0; i < kRuns; ++i) {
    const Vector6d e = log(steps(kWindow - 1, noisy) * steps(kWindow - 1, none).inverse());
    S += e * e.transpose() / kRuns;
  }
  GrowingCovariance covariance;
  for (FrameId k = kWindow - 1; k < kFrames; ++k)
    covariance.update(trajectoryOf(k - kWindow + 1, kWindow, twist), S);
  double nees = 0;
  for (int i = 0; i < kRuns; ++i) {
    const Vector6d e = log(steps(kFrames - 1, noisy) * steps(kFrames - 1, none).inverse());
    nees += e.dot(covariance.newest().llt().solve(e)) / 6 / kRuns;
  }
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2);
}

TEST(GrowingCovariance, LivesInTheNewestCamera) {
  Vector6d twist = Vector6d::Zero();
  twist(0) = 1;  // the first camera lies 1 m farther to the right with every frame
  GrowingCovariance covariance;
  Matrix6d turned = Matrix6d::Zero();
  turned(4, 4) = 1e-6;  // about y: it moves what is to the right along z
  covariance.continueFrom(0, turned);
  covariance.update(trajectoryOf(0, 2, twist), Matrix6d::Zero());
  EXPECT_NEAR(covariance.newest()(4, 4), 1e-6, 1e-12);
  EXPECT_NEAR(covariance.newest()(2, 2), 1e-6, 1e-12);
}

TEST(GrowingCovariance, CountsOnlyWhatLiesBehindTheFrameItGoesOnFrom) {
  GrowingCovariance covariance;
  const Matrix6d S = Vector6d(1e-6 * ones()).asDiagonal();
  covariance.update(trajectoryOf(0, 11, Vector6d::Zero()), S);
  const Matrix6d lost = Vector6d(1e-2 * ones()).asDiagonal();
  covariance.continueFrom(10, lost);
  covariance.update(trajectoryOf(1, 11, Vector6d::Zero()), S);  // frame 11 is the newest
  EXPECT_LT((covariance.newest() - lost - 0.1 * S).norm(), 1e-12);
  covariance.update(trajectoryOf(12, 11, Vector6d::Zero()), S);
  EXPECT_LT((covariance.newest() - lost - 1.1 * S).norm(), 1e-12);
}

constexpr std::int64_t kPeriod = 100'000'000;

TEST(PredictionErrors, AreThoseOfTheTimeThatWasLost) {
  TrajectoryOptions options;
  PredictionErrors errors;
  EXPECT_GT(errors.covariance(0.5, options)(0, 0), 0.5);  // nothing is known: (20 / 3 / 8)^2 m^2
  // To and fro along x, 0.2 m wide, 1 Hz.
  const double w = 2 * M_PI;
  for (int k = 0; k < 100; ++k) {
    const double t = 0.1 * k;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().x() = 0.1 * std::sin(w * t);
    Vector6d twist = Vector6d::Zero();
    twist(0) = 0.1 * w * std::cos(w * t);
    errors.add(k * kPeriod, T, twist);
  }
  const auto deviation = [&](double time, int axis) {
    return std::sqrt(errors.covariance(time, options)(axis, axis));
  };
  // x(t + 0.2) - x(t) - 0.2 v(t) has the amplitude 0.1 |exp(0.4 pi i) - 1 - 0.4 pi i| = 0.075.
  EXPECT_NEAR(deviation(0.2, 0), 0.075 / std::sqrt(2), 0.01);
  EXPECT_GT(deviation(0.4, 0), 2 * deviation(0.2, 0));
  EXPECT_LT(deviation(0.2, 1), 0.02);  // no more than what is possible, seen once in 50 times
}

}  // namespace
}  // namespace mvo
