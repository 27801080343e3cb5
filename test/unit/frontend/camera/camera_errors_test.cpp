// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A pair that is not what its calibration says goes through a field of points.
#include "frontend/camera/camera_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{700, 700, 610, 185, 0.54, 1240, 376};
constexpr double kPeriod = 0.1;
constexpr int kFrames = 30;

struct Drive {
  ErrorVector errors = ErrorVector::Zero();
  double step = 0.8;   // forward [m per frame]
  double noise = 0.1;  // [px]
  double wrong = 0;    // share of the points that move by themselves
};

Eigen::Isometry3d cameraAt(double t, const Drive& drive) {
  Vector6d xi;
  xi << 0.1 * std::sin(2 * t), 0.02 * std::sin(9 * t), -drive.step / kPeriod * t,
      0.005 * std::sin(8 * t), 0.15 * std::sin(1.5 * t), 0.004 * std::sin(5 * t);
  return exp(xi);
}

// Where the right eye really sees a point: (u_r, v_r).
Eigen::Vector2d rightPixel(const Eigen::Vector3d& exact, const Eigen::Vector2d& velocity,
                           const ErrorVector& errors) {
  return Eigen::Vector2d(exact.z(), exact.y()) + errorFields(kCamera, exact, velocity) * errors;
}

struct Outcome {
  CameraErrors errors{kCamera};
  Window exact;  // of the last window, as an exact pair would have seen it
  Window seen;
};

// All frames one by one; the motion that is handed over is what an uncorrected pair would find: the
// true one with a scale that is off.
Outcome learn(const Drive& drive) {
  Outcome outcome;
  TrackletWindow window({48, 1});
  TrackletWindow exact_window({48, 1});
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  struct Point {
    TrackletId id;
    Eigen::Vector3d p_world;
    Eigen::Vector3d velocity;  // [m per frame]
  };
  std::vector<Point> points;
  TrackletId next = 0;
  Trajectory world;
  const Eigen::Isometry3d first = cameraAt(0, drive);
  for (int k = 0; k < kFrames; ++k) {
    const double t = kPeriod * k;
    const Eigen::Isometry3d T_c_w = cameraAt(t, drive);
    const auto view = [&](const Point& p, double at) {
      return Eigen::Vector3d(cameraAt(at, drive) * (p.p_world + p.velocity * (at / kPeriod)));
    };
    const auto visible = [&](const Point& p) {
      const Eigen::Vector3d p_c = view(p, t);
      if (p_c.z() < 4) return false;
      const Eigen::Vector3d y = kCamera.project(p_c);
      return y.x() > 0 && y.x() < kCamera.width && y.y() > 0 && y.y() < kCamera.height && y.z() > 0;
    };
    points.erase(
        std::remove_if(points.begin(), points.end(), [&](const Point& p) { return !visible(p); }),
        points.end());
    while (points.size() < 300) {
      const double z = 1 / uniform(1.0 / 60, 1.0 / 5);
      const Eigen::Vector3d y(uniform(0, kCamera.width), uniform(0, kCamera.height), 0);
      const Eigen::Vector3d p_c((y.x() - kCamera.cu) / kCamera.fu * z,
                                (y.y() - kCamera.cv) / kCamera.fv * z, z);
      Point p{next++, T_c_w.inverse() * p_c, Eigen::Vector3d::Zero()};
      if (uniform(0, 1) < drive.wrong) {
        p.velocity = Eigen::Vector3d(0.3, 0, 0.1);
        p.p_world -= p.velocity * k;
      }
      if (visible(p)) points.push_back(p);
    }
    std::vector<Feature> seen;
    std::vector<Feature> exact;
    for (const Point& p : points) {
      const Eigen::Vector3d y = kCamera.project(view(p, t));
      const Eigen::Vector3d later = kCamera.project(view(p, t + 1e-3));
      const Eigen::Vector2d velocity = Eigen::Vector2d(later.z() - y.z(), later.y() - y.y()) / 1e-3;
      const Eigen::Vector2d right = rightPixel(y, velocity, drive.errors);
      const auto noise = [&] { return drive.noise * normal(random); };
      exact.push_back({p.id, y, y.y()});
      seen.push_back(
          {p.id, {y.x() + noise(), y.y() + noise(), right.x() + noise()}, right.y() + noise()});
    }
    window.add(k, seen);
    exact_window.add(k, exact);
    outcome.errors.addFrame(k, t, 49);
    outcome.errors.learnRows(seen, window);
    world.T_ck_c1.push_back(T_c_w * first.inverse());
    world.T_ck_c1.back().translation() *= 1.02;
    world.segment.push_back(0);
    const Window corrected = outcome.errors.corrected(window.window());
    std::vector<int> all(corrected.tracklets.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    const LinkResidual residual(kCamera, NoiseOptions(), ResidualModel::kWhitened);
    outcome.errors.learnMotion(corrected, world, all, residual);
  }
  outcome.exact = exact_window.window();
  outcome.seen = window.window();
  return outcome;
}

// Mean and root mean square difference of all disparities after the correction [px].
std::pair<double, double> disparityError(const Outcome& outcome) {
  const Window corrected = outcome.errors.corrected(outcome.seen);
  double sum = 0;
  double squares = 0;
  int n = 0;
  for (std::size_t p = 0; p < corrected.tracklets.size(); ++p)
    for (std::size_t j = 0; j < corrected.tracklets[p].observations.size(); ++j, ++n) {
      const double error = corrected.tracklets[p].observations[j].y.z() -
                           outcome.exact.tracklets[p].observations[j].y.z();
      sum += error;
      squares += error * error;
    }
  return {sum / n, std::sqrt(squares / n)};
}

Drive misaligned() {
  Drive drive;
  drive.errors[kTurn] = 1.5e-3;
  drive.errors[kTilt] = -1.2e-3;
  drive.errors[kRoll] = 1e-3;
  drive.errors[kScale] = 3e-3;
  drive.errors[kRadial] = 1e-3;
  drive.errors[kDelay] = 3e-3;
  return drive;
}

TEST(CameraErrors, FindsWhatAPairThatMovesDoesWrong) {
  const Drive drive = misaligned();
  const Outcome outcome = learn(drive);
  const auto [mean, rms] = disparityError(outcome);
  EXPECT_LT(std::abs(mean), 0.05);
  EXPECT_LT(rms, 0.25);  // of which noise is 0.1 and the delay's noisy velocity the rest
  const ErrorEstimate& estimate = outcome.errors.estimate();
  EXPECT_NEAR(estimate.mean[kDelay], drive.errors[kDelay], 0.5e-3);
  EXPECT_NEAR(estimate.mean[kRoll], drive.errors[kRoll], 2e-4);
  EXPECT_NEAR(estimate.mean[kScale], drive.errors[kScale], 5e-4);
}

TEST(CameraErrors, LeavesAnExactPairAlone) {
  const auto [mean, rms] = disparityError(learn({}));
  EXPECT_LT(std::abs(mean), 0.02);
  EXPECT_LT(rms, 0.11);
}

TEST(CameraErrors, KnowsHowWellItKnows) {
  // In standard deviations of the estimate, over the numbers' principal directions.
  for (const Drive& drive : {Drive(), misaligned()}) {
    const ErrorEstimate e = learn(drive).errors.estimate();
    const ErrorVector off = e.mean - drive.errors;
    const double squared = off.dot(e.covariance.inverse() * off);
    EXPECT_LT(squared, 3 * kErrorTerms);
  }
}

TEST(CameraErrors, ACameraAtRestLearnsRowsButNoDisparities) {
  Drive drive = misaligned();
  drive.step = 0;
  Drive still = drive;
  const Outcome moving = learn(misaligned());
  const Eigen::Vector3d y(400, 200, 390);
  const auto variance = [&y](const Outcome& outcome, int row) {
    const ErrorVector f = errorFields(kCamera, y, Eigen::Vector2d::Zero()).row(row).transpose();
    return f.dot(outcome.errors.estimate().covariance * f);
  };
  const Outcome turning = learn(still);
  EXPECT_LT(std::sqrt(variance(turning, 1)), 0.03);
  EXPECT_GT(variance(turning, 0), 4 * variance(moving, 0));
}

TEST(CameraErrors, PointsThatMoveByThemselvesDoNotMatterMuch) {
  Drive drive = misaligned();
  drive.wrong = 0.2;
  const auto [mean, rms] = disparityError(learn(drive));
  EXPECT_LT(std::abs(mean), 0.1);
  EXPECT_LT(rms, 0.3);
}

TEST(CameraErrors, GoesOnFromWhatWasKnownAndForgetsIt) {
  const ErrorEstimate known = learn(misaligned()).errors.estimate();
  CameraErrors errors(kCamera);
  errors.startFrom(known);
  const ErrorVector deviation = known.covariance.diagonal().cwiseSqrt();
  const auto off = [&] {
    return (errors.estimate().mean - known.mean).cwiseQuotient(deviation).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(off(), 1e-6);
  const ErrorMatrix ratio = errors.estimate().covariance * known.covariance.inverse();
  EXPECT_LT((ratio - ErrorMatrix::Identity()).cwiseAbs().maxCoeff(), 1e-4);
  for (int k = 0; k < 500; ++k) errors.addFrame(k, kPeriod * k, 49);
  errors.learnMotion({}, {}, {}, LinkResidual(kCamera, {}, ResidualModel::kWhitened));
  const ErrorVector growth =
      errors.estimate().covariance.diagonal().cwiseQuotient(known.covariance.diagonal());
  EXPECT_GT(growth.minCoeff(), 1);
  EXPECT_GT(growth[kDelay], 1.3);
}

TEST(CameraErrors, WhatIsKnownWorseThanExpectedIsNoEvidence) {
  ErrorEstimate vague = expectedErrors(kCamera);
  vague.covariance *= 4;
  CameraErrors errors(kCamera);
  errors.startFrom(vague);
  const ErrorEstimate prior = expectedErrors(kCamera);
  for (int i = 0; i < kErrorTerms; ++i)
    EXPECT_NEAR(errors.estimate().covariance(i, i), prior.covariance(i, i),
                1e-6 * prior.covariance(i, i));
}

TEST(CameraErrors, TheShiftIsTheFieldsTimesTheNumbers) {
  std::srand(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d y = Eigen::Vector3d(620, 188, 610) + 180 * Eigen::Vector3d::Random();
    const Eigen::Vector2d velocity = 100 * Eigen::Vector2d::Random();
    const ErrorVector numbers = 1e-2 * ErrorVector::Random();
    EXPECT_NEAR(shiftAcross(kCamera, y, velocity.x(), numbers),
                errorFields(kCamera, y, velocity).row(0).dot(numbers), 1e-12);
  }
}

TEST(CameraErrors, ExpectsAPixelOrTwo) {
  const ErrorEstimate prior = expectedErrors(kCamera);
  const Eigen::Vector3d middle(kCamera.cu, kCamera.cv, kCamera.cu - 10);
  const auto rows = prior.rows(kCamera, middle);
  EXPECT_EQ(rows.mean, 0);
  EXPECT_GT(rows.deviation, 0.7);
  EXPECT_LT(rows.deviation, 2.5);
}

}  // namespace
}  // namespace mvo
