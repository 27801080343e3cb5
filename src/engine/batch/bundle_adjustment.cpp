// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/bundle_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/batch/bundle_ceres.hpp"
#include "engine/batch/bundle_problem.hpp"
#include "engine/batch/bundle_schur.hpp"
#include "engine/batch/newest_frame_start.hpp"
#include "engine/batch/residual_noise.hpp"

namespace mvo {

namespace {

constexpr double kLeastFreedom = 0.05;  // of residuals, below which they do not tell their noise
constexpr double kPriorResiduals = 30;

// The share of the residuals that a batch leaves free.
double freedomOf(const BundleProblem& problem) {
  double unknowns = 6 * (static_cast<double>(problem.start.T_ck_c1.size()) - 1);
  for (const auto& landmark : problem.landmarks)
    if (landmark.span > 0) unknowns += 3;
  return std::max(kLeastFreedom, 1 - unknowns / (3.0 * problem.measurements));
}

// Of the batch's measurements, in the standard deviations that R_jk says; that it says 1 counts as
// much as a few residuals.
double noiseOf(const BundleProblem& problem, const BundleSolution& solution, double freedom) {
  const double scale = problem.robust_scale;
  const double residuals = 3.0 * problem.measurements * freedom;
  const double loss = 2 * solution.final_cost / (scale * scale * problem.measurements);
  const double found = scale > 0 ? residualNoise(loss, scale, freedom)
                                 : std::min(kMaxNoise, solution.rms / std::sqrt(freedom));
  return std::sqrt((kPriorResiduals + residuals * found * found) / (kPriorResiduals + residuals));
}

struct NewestCovariances {
  Matrix6d pose;  // of the left perturbation of T_ck_c1
  Matrix6d step;  // of that of T_ck_ckm1
};

// From the joint covariance of the newest two free poses by the normal equations.
std::optional<NewestCovariances> newestCovariances(const BundleState& state,
                                                   const JointCovariance& normal, double factor) {
  const JointCovariance joint = factor * normal;
  if (!joint.allFinite()) return std::nullopt;
  NewestCovariances out;
  out.pose = joint.bottomRightCorner<6, 6>();
  if (joint.rows() < 12) {  // the pose before is the held one
    out.step = out.pose;
    return out;
  }
  // T_ck_ckm1 = T_ck_c1 T_ckm1_c1^-1: its perturbation is xi_k - Ad(T_ck_ckm1) xi_km1.
  const auto newest = state.T_ck_c1.end();
  Eigen::Matrix<double, 6, 12> J_step_poses;
  J_step_poses << -adjoint(newest[-1] * newest[-2].inverse()), Matrix6d::Identity();
  out.step = J_step_poses * joint * J_step_poses.transpose();
  return out;
}

// None if the batch is singular at the state. The back end's last linearisation is taken for it if
// there is one without damping: that was one step before, where hardly anything differs.
std::optional<JointCovariance> undampedCovariance(const BundleState& state, ReducedSystem& system) {
  if (auto covariance = system.newestCovariance(2)) return covariance;
  system.factorize(state, 0);
  return system.newestCovariance(2);
}

BundleSolution solve(const BundleProblem& problem, const BundleAdjustmentOptions& options,
                     int iterations, ReducedSystem& system) {
  if (options.backend == BatchBackend::kSchur)
    return solveBundleWithSchur(problem, options, iterations, system);
  // Keeps Ceres from factorising, and complaining about, what is singular.
  system.setProblem(problem);
  if (!undampedCovariance(problem.start, system)) return {};
  system.setProblem(problem);  // forgets the factor at the start
  return solveBundleWithCeres(problem, options, iterations);
}

void writeBack(const BundleProblem& problem, const BundleState& state, Bundle& bundle) {
  for (std::size_t k = 1; k < state.T_ck_c1.size(); ++k) {
    bundle.T_ck_c1[k] = state.T_ck_c1[k];
    bundle.T_ck_c1[k].linear() =
        Eigen::Quaterniond(state.T_ck_c1[k].linear()).normalized().toRotationMatrix();
  }
  for (std::size_t j = 0; j < problem.landmarks.size(); ++j) {
    if (problem.landmarks[j].span == 0) continue;
    const Eigen::Vector3d& m = state.landmarks[j];
    bundle.tracks[j].p_c1 << problem.landmarks[j].chart.point(m), m.z();
  }
}

}  // namespace

struct BatchMemory::Piece {
  BundleProblem problem;
  ReducedSystem system;
};

BatchMemory::BatchMemory() = default;
BatchMemory::~BatchMemory() = default;

std::unique_ptr<BatchMemory::Piece> BatchMemory::borrow() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (spare_.empty()) return std::make_unique<Piece>();
  std::unique_ptr<Piece> piece = std::move(spare_.back());
  spare_.pop_back();
  return piece;
}

void BatchMemory::giveBack(std::unique_ptr<Piece> piece) {
  const std::lock_guard<std::mutex> lock(mutex_);
  spare_.push_back(std::move(piece));
}

BundleAdjuster::BundleAdjuster(const StereoCamera& camera, const NoiseOptions& noise,
                               const BundleAdjustmentOptions& options, BatchMemory& memory)
    : camera_(camera), noise_(noise), options_(options), memory_(memory), piece_(memory.borrow()) {}
BundleAdjuster::~BundleAdjuster() { memory_.giveBack(std::move(piece_)); }

std::optional<FrameId> BundleAdjuster::newestWeakFrame(const Bundle& bundle) const {
  const auto pose = newestWeakPose(bundle, camera_, noise_, options_.min_observations);
  if (!pose) return std::nullopt;
  return bundle.first_frame + *pose;
}

BatchSummary BundleAdjuster::adjust(Bundle& bundle, const BatchEffort& effort) {
  auto& [problem, system] = *piece_;
  BatchSummary summary;
  auto made = makeBundleProblem(bundle, camera_, noise_, options_, std::move(problem));
  if (!made) return summary;
  problem = *std::move(made);
  startNewestFrame(problem);
  const BundleSolution solution = solve(problem, options_, effort.iterations, system);
  summary.initial_cost = solution.initial_cost;
  summary.final_cost = solution.final_cost;
  summary.iterations = solution.iterations;
  if (!solution.usable) return summary;
  if (effort.wants_covariance) {
    const auto normal = undampedCovariance(solution.state, system);
    if (!normal) return summary;
    const double freedom = freedomOf(problem);
    summary.noise = noiseOf(problem, solution, freedom);
    const auto covariances = newestCovariances(
        solution.state, *normal, covarianceFactor(options_.robust_scale, summary.noise, freedom));
    if (!covariances) return summary;
    summary.covariance = covariances->pose;
    summary.step_covariance = covariances->step;
  }
  summary.usable = true;
  summary.converged = solution.converged;
  summary.rms = solution.rms;
  writeBack(problem, solution.state, bundle);
  return summary;
}

}  // namespace mvo
