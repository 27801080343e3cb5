// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bundle_problem.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mvo {

namespace {

// Measurements of a frame whose spread across their best line is below this many standard
// deviations do not say how the frame is turned about that line. Lines in space are lines in
// (u, v, disparity), so measurements show it without the noise of depth.
constexpr double kLeastSpread = 3.0;

// Disparity that noise can make of a point at infinity, in standard deviations; a start that is
// farther beyond infinity lies behind its camera.
constexpr double kBeyondInfinity = 4.0;

bool isPose(const Eigen::Isometry3d& T) {
  constexpr double tolerance = 1e-6;
  const Eigen::Matrix3d C = T.linear();
  return T.matrix().allFinite() &&
         (C.transpose() * C - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < tolerance &&
         C.determinant() > 0;
}

// Finite, and observations in order.
bool isSound(const Batch& batch) {
  const auto end = batch.first_frame + static_cast<FrameId>(batch.T_ck_c1.size());
  const auto sound = [&](const Batch::Landmark& landmark) {
    FrameId next = batch.first_frame;
    for (const auto& observation : landmark.observations) {
      if (!observation.y.allFinite() || observation.frame < next || observation.frame >= end)
        return false;
      next = observation.frame + 1;
    }
    return landmark.p_c1.allFinite();
  };
  return std::all_of(batch.T_ck_c1.begin(), batch.T_ck_c1.end(), isPose) &&
         std::all_of(batch.landmarks.begin(), batch.landmarks.end(), sound);
}

// Every pose has enough observations of points that another pose sees too, spread over more than a
// line.
bool posesAreConstrained(const BundleProblem& problem, int min_observations) {
  struct Moments {
    int count = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  };
  std::vector<Moments> moments(problem.start.T_ck_c1.size());
  for (const auto& landmark : problem.landmarks) {
    if (landmark.end - landmark.begin < 2) continue;
    for (int i = landmark.begin; i < landmark.end; ++i) {
      const auto& measurement = problem.measurements[static_cast<std::size_t>(i)];
      auto& of_pose = moments[static_cast<std::size_t>(measurement.pose)];
      const Eigen::Vector3d delta = measurement.h - of_pose.mean;
      of_pose.mean += delta / ++of_pose.count;
      of_pose.scatter += delta * (measurement.h - of_pose.mean).transpose();
    }
  }
  return std::all_of(moments.begin(), moments.end(), [&](const Moments& m) {
    if (m.count < min_observations) return false;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(m.scatter / m.count,
                                                                Eigen::EigenvaluesOnly);
    return spread.eigenvalues()(1) > kLeastSpread * kLeastSpread;
  });
}

// Landmarks connect all poses with each other.
bool posesAreConnected(const BundleProblem& problem) {
  std::vector<int> parent(problem.start.T_ck_c1.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int pose) {
    while (parent[static_cast<std::size_t>(pose)] != pose)
      pose = parent[static_cast<std::size_t>(pose)];
    return pose;
  };
  for (const auto& landmark : problem.landmarks)
    for (int i = landmark.begin + 1; i < landmark.end; ++i) {
      const int a = root(problem.measurements[static_cast<std::size_t>(i - 1)].pose);
      const int b = root(problem.measurements[static_cast<std::size_t>(i)].pose);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  return std::all_of(parent.begin(), parent.end(), [&](int pose) { return root(pose) == 0; });
}

// Inverse depth in the camera of the anchor; from the anchor's measurement where the start cannot
// have been seen there.
Eigen::Vector3d startOf(const Eigen::Vector4d& p_c1, const Eigen::Isometry3d& T_anchor_c1,
                        const Eigen::Vector3d& h, const Eigen::Vector3d& gain) {
  const Eigen::Vector4d q = T_anchor_c1.matrix() * p_c1;
  if (std::abs(q.z()) > 1e-12 * q.norm()) {
    Eigen::Vector3d m(q.x() / q.z(), q.y() / q.z(), q.w() / q.z());
    if (gain.z() * m.z() > -kBeyondInfinity) return m;
  }
  return h.cwiseQuotient(gain);
}

// Sum of f(|e|^2) over all measurements.
template <class Function>
double sumOverResiduals(const BundleProblem& problem, const BundleState& state, const Function& f) {
  double sum = 0;
  for (std::size_t j = 0; j < problem.landmarks.size(); ++j) {
    const auto& landmark = problem.landmarks[j];
    const Eigen::Vector3d p = landmark.chart.point(state.landmarks[j]);
    const double rho = state.landmarks[j].z();
    for (int i = landmark.begin; i < landmark.end; ++i) {
      const auto& measurement = problem.measurements[static_cast<std::size_t>(i)];
      const auto& T = state.T_ck_c1[static_cast<std::size_t>(measurement.pose)];
      sum += f(whitenedResidual(problem.gain, T.linear(), T.translation(), p, rho, measurement.h)
                   .squaredNorm());
    }
  }
  return sum;
}

}  // namespace

std::optional<BundleProblem> makeBundleProblem(const Batch& batch, const StereoCamera& camera,
                                               const NoiseOptions& noise,
                                               const BundleAdjustmentOptions& options) {
  if (batch.landmarks.empty() || batch.T_ck_c1.size() < 2 || !isSound(batch)) return std::nullopt;

  BundleProblem problem;
  problem.gain = {camera.fu / noise.left, camera.fv / noise.left,
                  camera.fu * camera.baseline / noise.disparity};
  if (!problem.gain.allFinite() || problem.gain.minCoeff() <= 0) return std::nullopt;
  problem.robust_scale = options.robust_scale;
  problem.start.T_ck_c1 = batch.T_ck_c1;
  problem.landmarks.reserve(batch.landmarks.size());
  problem.start.landmarks.reserve(batch.landmarks.size());
  problem.measurements.reserve(std::accumulate(
      batch.landmarks.begin(), batch.landmarks.end(), std::size_t{0},
      [](std::size_t n, const Batch::Landmark& l) { return n + l.observations.size(); }));

  for (const auto& landmark : batch.landmarks) {
    BundleProblem::Landmark row;
    row.begin = static_cast<int>(problem.measurements.size());
    for (const auto& observation : landmark.observations) {
      const Eigen::Vector3d& y = observation.y;
      problem.measurements.push_back(
          {static_cast<int>(observation.frame - batch.first_frame),
           {(y.x() - camera.cu) / noise.left, (y.y() - camera.cv) / noise.left,
            (y.x() - y.z()) / noise.disparity}});
    }
    row.end = static_cast<int>(problem.measurements.size());
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    if (row.end > row.begin) {
      const auto& anchor =
          problem.measurements[static_cast<std::size_t>((row.begin + row.end) / 2)];
      const Eigen::Isometry3d& T_anchor_c1 = batch.T_ck_c1[static_cast<std::size_t>(anchor.pose)];
      const Eigen::Isometry3d T_c1_anchor = T_anchor_c1.inverse();
      row.chart.B << T_c1_anchor.linear().leftCols<2>(), T_c1_anchor.translation();
      row.chart.origin = T_c1_anchor.linear().col(2);
      start = startOf(landmark.p_c1, T_anchor_c1, anchor.h, problem.gain);
    }
    problem.landmarks.push_back(row);
    problem.start.landmarks.push_back(start);
  }
  if (!posesAreConstrained(problem, options.min_observations) || !posesAreConnected(problem))
    return std::nullopt;
  return problem;
}

double robustCost(double squared, double scale) {
  return 0.5 * (scale > 0 ? scale * scale * std::log1p(squared / (scale * scale)) : squared);
}

double bundleCost(const BundleProblem& problem, const BundleState& state) {
  return sumOverResiduals(
      problem, state, [&](double squared) { return robustCost(squared, problem.robust_scale); });
}

double bundleRms(const BundleProblem& problem, const BundleState& state) {
  const double squares = sumOverResiduals(problem, state, [](double squared) { return squared; });
  return std::sqrt(squares / (3.0 * static_cast<double>(problem.measurements.size())));
}

}  // namespace mvo
