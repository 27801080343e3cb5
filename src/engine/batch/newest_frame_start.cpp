// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/newest_frame_start.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace mvo {

namespace {

// Widths of the loss, in units of the batch's own, one for each step: wide at first, so that a
// start that is far off is heard.
constexpr std::array<double, 5> kWidths = {16, 4, 1, 1, 1};
constexpr std::array<double, 3> kLandmarkWidths = {4, 1, 1};
constexpr int kLeastPoints = 6;  // that a pose is estimated from

// A measurement of a known landmark in the newest pose.
struct Sighting {
  std::size_t landmark;
  Eigen::Vector3d h;
};

double cost(double squared, double scale) {
  return scale > 0 ? scale * scale * std::log1p(squared / (scale * scale)) : squared;
}

std::vector<Sighting> newestSightings(const BundleProblem& problem) {
  const int newest = static_cast<int>(problem.start.T_ck_c1.size()) - 1;
  std::vector<Sighting> sightings;
  for (std::size_t j = 0; j < problem.landmarks.size(); ++j) {
    const auto& landmark = problem.landmarks[j];
    if (!landmark.is_known || landmark.first + landmark.span - 1 != newest) continue;
    problem.forEachMeasurement(landmark, [&](int pose, const Eigen::Vector3d& h) {
      if (pose == newest) sightings.push_back({j, h});
    });
  }
  return sightings;
}

void startNewestPose(BundleProblem& problem) {
  const std::vector<Sighting> sightings = newestSightings(problem);
  if (static_cast<int>(sightings.size()) < kLeastPoints) return;
  const auto costAt = [&](const Eigen::Isometry3d& T) {
    double sum = 0;
    for (const Sighting& s : sightings) {
      const Eigen::Vector3d& m = problem.start.landmarks[s.landmark];
      const Eigen::Vector3d p = problem.landmarks[s.landmark].chart.point(m);
      sum += cost(
          whitenedResidual(problem.gain, T.linear(), T.translation(), p, m.z(), s.h).squaredNorm(),
          problem.robust_scale);
    }
    return sum;
  };
  Eigen::Isometry3d& newest = problem.start.T_ck_c1.back();
  Eigen::Isometry3d T = newest;
  for (const double width : kWidths) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (const Sighting& s : sightings) {
      const BundleResidual r = linearizeResidual(problem.gain, T.linear(), T.translation(),
                                                 problem.landmarks[s.landmark].chart,
                                                 problem.start.landmarks[s.landmark], s.h);
      const double weight = robustWeight(r.e.squaredNorm(), width * problem.robust_scale);
      H.noalias() += (weight * r.J_pose).transpose() * r.J_pose;
      g.noalias() += r.J_pose.transpose() * (weight * r.e);
    }
    const Vector6d step = -H.ldlt().solve(g);
    if (!step.allFinite()) return;
    T = exp(step) * T;
  }
  T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  if (costAt(T) < costAt(newest)) newest = T;
}

void startLandmark(BundleProblem& problem, std::size_t j) {
  const auto& landmark = problem.landmarks[j];
  Eigen::Vector3d& start = problem.start.landmarks[j];
  const auto costAt = [&](const Eigen::Vector3d& m) {
    double sum = 0;
    problem.forEachMeasurement(landmark, [&](int pose, const Eigen::Vector3d& h) {
      const Eigen::Isometry3d& T = problem.start.T_ck_c1[static_cast<std::size_t>(pose)];
      sum += cost(whitenedResidual(problem.gain, T.linear(), T.translation(),
                                   landmark.chart.point(m), m.z(), h)
                      .squaredNorm(),
                  problem.robust_scale);
    });
    return sum;
  };
  Eigen::Vector3d m = start;
  for (const double width : kLandmarkWidths) {
    Eigen::Matrix3d V = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    problem.forEachMeasurement(landmark, [&](int pose, const Eigen::Vector3d& h) {
      const Eigen::Isometry3d& T = problem.start.T_ck_c1[static_cast<std::size_t>(pose)];
      const BundleResidual r =
          linearizeResidual(problem.gain, T.linear(), T.translation(), landmark.chart, m, h);
      const double weight = robustWeight(r.e.squaredNorm(), width * problem.robust_scale);
      V.noalias() += (weight * r.J_landmark).transpose() * r.J_landmark;
      g.noalias() += r.J_landmark.transpose() * (weight * r.e);
    });
    m -= V.llt().solve(g);
    if (!m.allFinite()) return;
  }
  if (costAt(m) < costAt(start)) start = m;
}

}  // namespace

void startNewestFrame(BundleProblem& problem) {
  if (!problem.is_warm) return;
  startNewestPose(problem);
  for (std::size_t j = 0; j < problem.landmarks.size(); ++j)
    if (!problem.landmarks[j].is_known && problem.landmarks[j].span > 1) startLandmark(problem, j);
}

}  // namespace mvo
