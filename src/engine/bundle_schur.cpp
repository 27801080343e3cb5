// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bundle_schur.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "dense_kernels.hpp"

namespace mvo {

namespace {

using Eigen::Index;

// Landmarks whose part of the Schur complement is subtracted in one pass over memory.
constexpr std::size_t kGroup = 4;

// Below this many measurements a thread costs more than it brings.
constexpr std::size_t kWorthAThread = 3000;

// Information that elimination leaves of a perturbation's own; less is rounding, i.e. a direction
// that the batch says nothing about.
constexpr double kLeastInformation = 1e-11;

template <class T>
T& at(std::vector<T>& values, int i) {
  return values[static_cast<std::size_t>(i)];
}
template <class T>
const T& at(const std::vector<T>& values, int i) {
  return values[static_cast<std::size_t>(i)];
}

Eigen::Matrix3d damped(const Eigen::Matrix3d& V, double lambda) {
  Eigen::Matrix3d out = V;
  out.diagonal() *= 1.0 + lambda;
  return out;
}

}  // namespace

ReducedSystem::ReducedSystem(const BundleProblem& problem)
    : problem_(problem),
      parallel_(problem.measurements.size() >= kWorthAThread),
      V_(problem.landmarks.size()),
      gl_(problem.landmarks.size()),
      W_(problem.measurements.size()),
      H_(problem.start.T_ck_c1.size()) {
  const auto& landmarks = problem.landmarks;
  for (std::size_t j = 0; j < landmarks.size(); ++j)
    if (landmarks[j].begin < landmarks[j].end) order_.push_back(static_cast<int>(j));
  const auto span = [&](int j) {
    const auto& landmark = at(landmarks, j);
    return std::make_pair(at(problem.measurements, landmark.begin).pose,
                          at(problem.measurements, landmark.end - 1).pose);
  };
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return span(a) < span(b); });

  // Halves of equal work, which grows with the square of a landmark's span.
  const auto work = [&](int j) {
    const double length = span(j).second - span(j).first + 4;
    return length * length;
  };
  double rest = 0;
  for (const int j : order_) rest += work(j);
  const double half = rest / 2;
  std::size_t middle = 0;
  while (middle < order_.size() && rest > half) rest -= work(order_[middle++]);
  halves_[0].end = halves_[1].begin = middle;
  halves_[1].end = order_.size();

  const auto poses = problem.start.T_ck_c1.size();
  const auto n = static_cast<Index>(6 * (poses - 1));
  for (auto& part : halves_) {
    part.H.resize(poses);
    part.g.resize(poses);
    part.S.resize(n + kTilePadding, n + kTilePadding);
    part.b.resize(n);
    part.U.resize(n + kTilePadding, 3 * static_cast<Index>(kGroup));
  }
}

template <class Function>
void ReducedSystem::forBothHalves(const Function& function) {
  if (!parallel_) {
    for (auto& half : halves_) function(half);
    return;
  }
  cv::parallel_for_(cv::Range(0, 2), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) function(halves_[i]);
  });
}

void ReducedSystem::linearizeHalf(const BundleState& state, Half& half) {
  std::fill(half.H.begin(), half.H.end(), Matrix6d::Zero());
  std::fill(half.g.begin(), half.g.end(), Vector6d::Zero());
  for (std::size_t o = half.begin; o < half.end; ++o) {
    const int j = order_[o];
    const auto& landmark = at(problem_.landmarks, j);
    const Eigen::Vector3d& m = at(state.landmarks, j);
    Eigen::Matrix3d V = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gl = Eigen::Vector3d::Zero();
    for (int i = landmark.begin; i < landmark.end; ++i) {
      const auto& measurement = at(problem_.measurements, i);
      const auto& T = at(state.T_ck_c1, measurement.pose);
      const BundleResidual r = linearizeResidual(problem_.gain, T.linear(), T.translation(),
                                                 landmark.chart, m, measurement.h);
      const double weight = robustWeight(r.e.squaredNorm(), problem_.robust_scale);
      const Eigen::Vector3d e = weight * r.e;
      const Eigen::Matrix3d J = weight * r.J_landmark;
      V.noalias() += J.transpose() * r.J_landmark;
      gl.noalias() += r.J_landmark.transpose() * e;
      at(half.H, measurement.pose).noalias() += (weight * r.J_pose).transpose() * r.J_pose;
      at(half.g, measurement.pose).noalias() += r.J_pose.transpose() * e;
      at(W_, i).noalias() = r.J_pose.transpose() * J;
    }
    at(V_, j) = V;
    at(gl_, j) = gl;
  }
}

void ReducedSystem::linearize(const BundleState& state) {
  forBothHalves([&](Half& half) { linearizeHalf(state, half); });
  g_.resize(static_cast<Index>(6 * (H_.size() - 1)));
  for (std::size_t k = 1; k < H_.size(); ++k) {
    H_[k] = halves_[0].H[k] + halves_[1].H[k];
    g_.segment<6>(static_cast<Index>(6 * (k - 1))) = halves_[0].g[k] + halves_[1].g[k];
  }
}

void ReducedSystem::eliminateHalf(double lambda, Half& half) {
  half.S.setZero();
  half.b.setZero();
  for (std::size_t begin = half.begin; begin < half.end; begin += kGroup) {
    const std::size_t end = std::min(begin + kGroup, half.end);
    int first = static_cast<int>(H_.size());
    int last = 0;
    for (std::size_t o = begin; o < end; ++o) {
      const auto& landmark = at(problem_.landmarks, order_[o]);
      first = std::min(first, at(problem_.measurements, landmark.begin).pose);
      last = std::max(last, at(problem_.measurements, landmark.end - 1).pose);
    }
    first = std::max(first, 1);
    if (last < first) continue;
    const Index rows = 6 * (last - first + 1);
    half.U.topRows(rows + kTilePadding).setZero();
    Eigen::Matrix<double, 3 * kGroup, 1> y = Eigen::Matrix<double, 3 * kGroup, 1>::Zero();
    for (std::size_t o = begin; o < end; ++o) {
      const int j = order_[o];
      const auto& landmark = at(problem_.landmarks, j);
      const Eigen::LLT<Eigen::Matrix3d> llt(damped(at(V_, j), lambda));
      const Eigen::Matrix3d inverse = llt.matrixL().solve(Eigen::Matrix3d::Identity());
      const auto column = static_cast<Index>(3 * (o - begin));
      y.segment<3>(column) = inverse * at(gl_, j);
      for (int i = landmark.begin; i < landmark.end; ++i) {
        const int pose = at(problem_.measurements, i).pose;
        if (pose > 0)
          half.U.block<6, 3>(6 * (pose - first), column).noalias() =
              at(W_, i) * inverse.transpose();
      }
    }
    const Index at_pose = 6 * (first - 1);
    half.b.segment(at_pose, rows).noalias() -= half.U.topRows(rows) * y;
    subtractGram(&half.S(at_pose, at_pose), half.S.outerStride(), half.U.data(),
                 half.U.outerStride(), rows, half.U.cols());
  }
}

bool ReducedSystem::factorize(double lambda) {
  lambda_ = lambda;
  forBothHalves([&](Half& half) { eliminateHalf(lambda, half); });
  auto& S = halves_[0].S;
  const Index n = g_.size();
  for (Index c = 0; c < n; ++c) S.col(c).segment(c, n - c) += halves_[1].S.col(c).segment(c, n - c);
  Eigen::VectorXd own(n);
  for (std::size_t k = 1; k < H_.size(); ++k) {
    const auto row = static_cast<Index>(6 * (k - 1));
    S.block<6, 6>(row, row) += H_[k];
    own.segment<6>(row) = H_[k].diagonal();
  }
  S.diagonal().head(n) += lambda * own;
  b_ = g_ + halves_[0].b + halves_[1].b;
  if (!choleskyInPlace(S, n)) return false;
  const Eigen::ArrayXd pivots = S.diagonal().head(n).array().square();
  return (pivots > kLeastInformation * own.array()).all();
}

ReducedSystem::Step ReducedSystem::step() const {
  const Eigen::VectorXd dx = choleskySolve(halves_[0].S, -b_);

  // With (H + lambda D) dx = -g the model's decrease is (lambda dx^T D dx - g^T dx) / 2.
  Step step;
  double decrease = -g_.dot(dx);
  step.poses.push_back(Vector6d::Zero());
  for (std::size_t k = 1; k < H_.size(); ++k) {
    step.poses.emplace_back(dx.segment<6>(static_cast<Index>(6 * (k - 1))));
    decrease += lambda_ * step.poses[k].cwiseAbs2().dot(H_[k].diagonal());
  }
  step.landmarks.assign(V_.size(), Eigen::Vector3d::Zero());
  for (const int j : order_) {
    const auto& landmark = at(problem_.landmarks, j);
    Eigen::Vector3d g = at(gl_, j);
    for (int i = landmark.begin; i < landmark.end; ++i)
      g.noalias() += at(W_, i).transpose() * at(step.poses, at(problem_.measurements, i).pose);
    Eigen::Vector3d& dm = at(step.landmarks, j);
    dm = -damped(at(V_, j), lambda_).llt().solve(g);
    decrease += lambda_ * dm.cwiseAbs2().dot(at(V_, j).diagonal()) - at(gl_, j).dot(dm);
  }
  step.predicted = 0.5 * decrease;
  return step;
}

Eigen::MatrixXd ReducedSystem::newestCovariance(int poses) const {
  const Index n = g_.size();
  const Index m = std::min<Index>(6 * poses, n);
  // The last rows of the factor hold the newest poses' information after all others.
  const Eigen::MatrixXd L = halves_[0].S.block(n - m, n - m, m, m);
  const Eigen::MatrixXd root =
      L.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(m, m));
  return root.transpose() * root;
}

BundleSolution solveBundleWithSchur(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations) {
  const bool gauss_newton = options.damping == DampingMethod::kGaussNewton;
  BundleSolution solution;
  solution.state = problem.start;
  solution.initial_cost = bundleCost(problem, solution.state);
  double cost = solution.initial_cost;
  ReducedSystem system(problem);
  double lambda = gauss_newton ? 0.0 : kInitialDamping;
  double growth = 2;
  bool moved = true;
  for (; solution.iterations < iterations && !solution.converged; ++solution.iterations) {
    if (moved) system.linearize(solution.state);
    moved = false;
    double change = 0;
    if (system.factorize(lambda)) {
      const ReducedSystem::Step step = system.step();
      BundleState candidate = solution.state;
      for (std::size_t k = 1; k < candidate.T_ck_c1.size(); ++k)
        candidate.T_ck_c1[k] = exp(step.poses[k]) * candidate.T_ck_c1[k];
      for (std::size_t j = 0; j < candidate.landmarks.size(); ++j)
        candidate.landmarks[j] += step.landmarks[j];
      const double candidate_cost = bundleCost(problem, candidate);
      change = cost - candidate_cost;
      solution.converged = isConverged(change, cost, options.function_tolerance);
      moved = change > 0;
      if (moved) {
        solution.state = std::move(candidate);
        cost = candidate_cost;
        const double quality = change / step.predicted;
        lambda *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * quality - 1.0, 3));
        growth = 2;
      }
    }
    if (moved || solution.converged) continue;
    if (gauss_newton) return solution;  // diverged, or singular
    lambda *= growth;
    growth *= 2;
  }
  solution.final_cost = cost;
  solution.usable = std::isfinite(cost);
  return solution;
}

}  // namespace mvo
