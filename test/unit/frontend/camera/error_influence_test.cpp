// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A motion that is estimated from disparities that are all wrong in the same way.
#include "frontend/camera/error_influence.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 320, 240, 0.12, 640, 480};
constexpr int kFrames = 6;

Eigen::Isometry3d cameraAt(FrameId frame) {
  Vector6d twist;
  twist << 0.02, 0.005, -0.05, 0.002, 0.01, -0.003;
  return exp(static_cast<double>(frame) * twist);
}

// What a pair with some errors sees of points between 1 and 6 m; without noise.
Window seenBy(const ErrorVector& errors) {
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Window window;
  window.last_frame = kFrames - 1;
  for (TrackletId id = 0; id < 100; ++id) {
    const Eigen::Vector3d p = kCamera.backProject(kCamera.project(
        Eigen::Vector3d(uniform(-0.4, 0.4), uniform(-0.3, 0.3), 1) * uniform(1.5, 6)));
    Tracklet t;
    t.id = id;
    for (FrameId k = 0; k < kFrames; ++k) {
      Eigen::Vector3d y = kCamera.project(cameraAt(k) * p);
      y.z() += shiftAcross(kCamera, y, 0, errors);
      t.observations.push_back({k, y});
    }
    window.tracklets.push_back(std::move(t));
  }
  return window;
}

CameraErrors clocked() {
  CameraErrors errors(kCamera);
  for (FrameId k = 0; k < kFrames; ++k) errors.addFrame(k, 0.1 * static_cast<double>(k), 48);
  return errors;
}

std::vector<int> allOf(const Window& window) {
  std::vector<int> all(window.tracklets.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Eigen::Isometry3d fitted(const Window& window, FrameId a, FrameId b, const LinkResidual& residual) {
  Eigen::Isometry3d T = cameraAt(b - a);
  for (int i = 0; i < 10; ++i) {
    Matrix6d A = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (const Tracklet& t : window.tracklets) {
      Link link;
      if (!residual.linearize(T, t.find(a)->y, t.find(b)->y, &link)) continue;
      A += link.jacobian.transpose() * link.information * link.jacobian;
      g += link.jacobian.transpose() * link.information * link.residual;
    }
    T = exp(A.ldlt().solve(g)) * T;
  }
  return T;
}

TEST(ErrorInfluence, IsWhatAWrongPairMakesOfAMotion) {
  const LinkResidual residual(kCamera, NoiseOptions(), ResidualModel::kWhitened);
  const CameraErrors errors = clocked();
  for (const ErrorTerm term : {kAcross, kRadial, kTurn, kWidth, kShear}) {
    ErrorVector truth = ErrorVector::Zero();
    truth[term] = 2e-4;  // a tenth of a pixel
    const Window window = seenBy(truth);
    const Eigen::Isometry3d T = fitted(window, 1, 2, residual);
    const auto by_errors = errors.motionByErrors(window, 1, 2, T, allOf(window), residual);
    ASSERT_TRUE(by_errors);
    const Vector6d missed = log(cameraAt(1) * T.inverse());
    ASSERT_GT(missed.norm(), 1e-6) << term;
    EXPECT_LT((*by_errors * truth - missed).norm(), 0.1 * missed.norm()) << term;
  }
}

TEST(ErrorInfluence, NeedsAFewTracklets) {
  const LinkResidual residual(kCamera, NoiseOptions(), ResidualModel::kWhitened);
  const Window window = seenBy(ErrorVector::Zero());
  const CameraErrors errors = clocked();
  EXPECT_FALSE(errors.motionByErrors(window, 1, 2, cameraAt(1), {0, 1, 2, 3, 4}, residual));
  EXPECT_TRUE(errors.motionByErrors(window, 1, 2, cameraAt(1), {0, 1, 2, 3, 4, 5}, residual));
}

// Of a whole window more than of a step, and as much again in the next frame.
TEST(ErrorInfluence, AddsUpOverTheWindow) {
  const LinkResidual residual(kCamera, NoiseOptions(), ResidualModel::kWhitened);
  const Window window = seenBy(ErrorVector::Zero());
  const CameraErrors errors = clocked();
  Segmentation segmentation;
  LabelEstimate estimate;
  for (FrameId k = 0; k < kFrames; ++k) {
    estimate.trajectory.T_ck_c1.push_back(cameraAt(k));
    estimate.trajectory.segment.push_back(0);
  }
  segmentation.labeling.labels = {{kStatic, estimate.trajectory}, {kOutlier, estimate.trajectory}};
  segmentation.labeling.assignment.assign(window.tracklets.size(), 0);
  segmentation.estimates = {estimate, estimate};
  ErrorInfluence influence;
  influence.addTo(segmentation, window, errors, residual);
  const BatchSummary first = segmentation.estimates[0]->summary;
  EXPECT_EQ(segmentation.estimates[1]->summary.covariance, Matrix6d::Zero());  // has no id

  const auto of_step =
      errors.motionByErrors(window, kFrames - 2, kFrames - 1, cameraAt(1), allOf(window), residual);
  const Matrix6d expected = *of_step * errors.estimate().covariance * of_step->transpose();
  EXPECT_LT((first.step_covariance - expected).norm(), 0.25 * expected.norm());  // a part tells
  // Five steps that err alike: five times the error, 25 times the variance.
  const double growth = first.covariance.trace() / first.step_covariance.trace();
  EXPECT_GT(growth, 15);
  EXPECT_LT(growth, 40);

  segmentation.estimates = {estimate, estimate};
  influence.addTo(segmentation, window, errors, residual);
  EXPECT_EQ(segmentation.estimates[0]->summary.covariance, first.covariance);
}

}  // namespace
}  // namespace mvo
