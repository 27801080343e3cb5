// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/bundle_schur.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <tuple>

#include "kernels/dense.hpp"

namespace mvo {

namespace {

using Eigen::Index;

constexpr std::size_t kGroup = 8;             // landmarks
constexpr std::size_t kColumns = 3 * kGroup;  // of a group's factor
constexpr std::size_t kPaddingRows = 24;      // below it: the poses that fill a block, tiles
static_assert(kPaddingRows >= kTilePadding && kPaddingRows >= 6 * (kDoubles - 1));

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

// Row of a free pose in the reduced system.
Index rowOf(int pose) { return 6 * (static_cast<Index>(pose) - 1); }

// L^-1 of V = L L^T, both row by row.
std::array<double, 6> inverseFactor(const std::array<double, 6>& V) {
  const double l00 = std::sqrt(V[0]);
  const double l10 = V[1] / l00;
  const double l11 = std::sqrt(V[2] - l10 * l10);
  const double l20 = V[3] / l00;
  const double l21 = (V[4] - l20 * l10) / l11;
  const double l22 = std::sqrt(V[5] - l20 * l20 - l21 * l21);
  std::array<double, 6> K{};
  K[0] = 1 / l00;
  K[2] = 1 / l11;
  K[5] = 1 / l22;
  K[1] = -l10 * K[0] * K[2];
  K[4] = -l21 * K[2] * K[5];
  K[3] = -(l20 * K[0] + l21 * K[1]) * K[5];
  return K;
}

}  // namespace

void ReducedSystem::setProblem(const BundleProblem& problem) {
  problem_ = &problem;
  parallel_ = isBatchSplit(static_cast<std::size_t>(problem.measurements));
  is_factorized_ = false;
  sortLandmarks();

  // Halves of equal work, which grows with the square of a landmark's span.
  const auto work = [&](int j) {
    const double length = at(problem.landmarks, j).span + 3;
    return length * length;
  };
  double rest = 0;
  for (const int j : order_) rest += work(j);
  const double half = rest / 2;
  std::size_t middle = 0;
  while (middle < order_.size() && rest > half) rest -= work(order_[middle++]);
  setGroups(0, middle, halves_[0]);
  setGroups(middle, order_.size(), halves_[1]);

  const auto poses = problem.start.T_ck_c1.size();
  const Index n = rowOf(static_cast<int>(poses));
  eliminated_.resize(order_.size());
  g_.resize(n);
  own_.resize(n);
  dx_.resize(n);
  step_.poses.resize(poses);
  step_.landmarks.assign(problem.landmarks.size(), Eigen::Vector3d::Zero());
  for (auto& part : halves_)
    if (part.S.rows() != n + kTilePadding) {
      part.S.resize(n + kTilePadding, n + kTilePadding);
      part.b.resize(n);
    }
}

void ReducedSystem::sortLandmarks() {
  const auto& landmarks = problem_->landmarks;
  order_.clear();
  for (std::size_t j = 0; j < landmarks.size(); ++j)
    if (landmarks[j].span > 0) order_.push_back(static_cast<int>(j));
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const auto& left = at(landmarks, a);
    const auto& right = at(landmarks, b);
    return std::tie(left.first, right.span, a) < std::tie(right.first, left.span, b);
  });

  const auto poses = static_cast<int>(problem_->start.T_ck_c1.size());
  reach_.clear();
  Index reach = 0;
  auto next = order_.begin();
  for (int k = 0; k < poses; ++k) {
    reach = std::max(reach, rowOf(k + 1));
    for (; next != order_.end() && at(landmarks, *next).first == k; ++next)
      reach = std::max(reach, rowOf(k + at(landmarks, *next).span));
    if (k > 0) reach_.insert(reach_.end(), 6, reach);
  }
}

void ReducedSystem::setGroups(std::size_t begin, std::size_t end, Half& half) {
  half.groups.clear();
  std::size_t size = 0;
  for (; begin < end; begin += kGroup) {
    Group group;
    group.begin = begin;
    group.end = std::min(begin + kGroup, end);
    group.first = at(problem_->landmarks, order_[begin]).first;
    for (std::size_t o = group.begin; o < group.end; ++o) {
      const auto& landmark = at(problem_->landmarks, order_[o]);
      group.last = std::max(group.last, landmark.first + landmark.span - 1);
    }
    group.at = size;
    group.stride = 6 * static_cast<std::size_t>(group.last - group.first + 1) + kPaddingRows;
    size += group.stride * kColumns;
    half.groups.push_back(group);
    // So that the landmarks that reach a row are the first of their group.
    const auto lastOf = [&](int j) {
      return at(problem_->landmarks, j).first + at(problem_->landmarks, j).span;
    };
    const auto group_begin = order_.begin() + static_cast<std::ptrdiff_t>(group.begin);
    const auto group_end = order_.begin() + static_cast<std::ptrdiff_t>(group.end);
    std::stable_sort(group_begin, group_end, [&](int a, int b) { return lastOf(a) > lastOf(b); });
  }
  if (half.U.size() < size) half.U.resize(size);
  half.coupling.resize(kCouplingPerBlock * (problem_->start.T_ck_c1.size() / kDoubles + 1));
}

template <class Function>
void ReducedSystem::forBothHalves(const Function& function) {
  if (!parallel_) {
    for (auto& half : halves_) function(half);
    return;
  }
  cv::parallel_for_(cv::Range(0, 2), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) function(halves_[static_cast<std::size_t>(i)]);
  });
}

void ReducedSystem::eliminateGroup(const BundleState& state, double lambda, const Group& group,
                                   Half& half) {
  double* const U = half.U.data() + group.at;
  std::array<double, kColumns> y{};
  for (std::size_t o = group.begin; o < group.end; ++o) {
    const int j = order_[o];
    const auto& landmark = at(problem_->landmarks, j);
    const auto first = static_cast<std::size_t>(landmark.first);
    const LandmarkTerms terms = linearizeLandmark(
        problem_->measured(static_cast<std::size_t>(j), at(state.landmarks, j)), poses_.at(first),
        poses_.stride(), half.sums.at(first), half.coupling.data(), half.residuals);

    auto& out = eliminated_[o];
    auto& K = out.inverse;
    const auto& V = terms.V;
    out.damping = {lambda * V[0], lambda * V[2], lambda * V[5]};
    K = inverseFactor(
        {V[0] + out.damping[0], V[1], V[2] + out.damping[1], V[3], V[4], V[5] + out.damping[2]});
    out.y = {K[0] * terms.g[0], K[1] * terms.g[0] + K[2] * terms.g[1],
             K[3] * terms.g[0] + K[4] * terms.g[1] + K[5] * terms.g[2]};

    const std::size_t column = 3 * (o - group.begin);
    std::copy(out.y.begin(), out.y.end(), y.begin() + static_cast<std::ptrdiff_t>(column));
    const std::size_t begin = 6 * static_cast<std::size_t>(landmark.first - group.first);
    const std::size_t end = std::min(begin + 6 * kDoubles * landmark.blocks(), group.stride);
    for (std::size_t c = column; c < column + 3; ++c) {
      double* u = U + c * group.stride;
      std::fill(u, u + begin, 0.0);
      std::fill(u + end, u + group.stride, 0.0);
    }
    writeFactor(half.coupling.data(), landmark.blocks(), K, U + column * group.stride + begin,
                group.stride);
  }

  const int first_free = std::max(group.first, 1);
  const Index rows = rowOf(group.last + 1) - rowOf(first_free);
  if (rows <= 0) return;
  const auto stride = static_cast<Index>(group.stride);
  const double* const free = U + 6 * (first_free - group.first);
  const auto columns = static_cast<Index>(3 * (group.end - group.begin));
  const Index row = rowOf(first_free);
  half.ends.clear();
  for (std::size_t o = group.begin; o < group.end; ++o) {
    const auto& landmark = at(problem_->landmarks, order_[o]);
    half.ends.insert(half.ends.end(), 3, rowOf(landmark.first + landmark.span) - row);
  }
  subtractProduct(half.b.data() + row, free, stride, rows, columns, y.data());
  subtractGram(&half.S(row, row), half.S.outerStride(), free, stride, rows, half.ends);
}

void ReducedSystem::eliminateHalf(const BundleState& state, double lambda, Half& half) {
  half.sums.reset(kSumRows, state.T_ck_c1.size());
  half.residuals = {};
  half.b.setZero();
  for (Index c = 0; c < half.S.cols(); ++c) half.S.col(c).tail(half.S.rows() - c).setZero();
  for (const Group& group : half.groups) eliminateGroup(state, lambda, group, half);
}

BundleCost ReducedSystem::totalCost() const {
  ResidualSums sums = halves_[0].residuals;
  const ResidualSums& other = halves_[1].residuals;
  sums.logarithms += other.totalLogarithms();
  for (std::size_t lane = 0; lane < kDoubles; ++lane) sums.squares[lane] += other.squares[lane];
  return bundleCost(*problem_, sums);
}

void ReducedSystem::linearize(const BundleState& state) {
  fillPoses(state.T_ck_c1, poses_);
  forBothHalves([&](Half& half) { eliminateHalf(state, lambda_, half); });
  cost_ = totalCost();
  for (std::size_t k = 1; k < state.T_ck_c1.size(); ++k)
    for (std::size_t r = 0; r < 6; ++r)
      g_(rowOf(static_cast<int>(k)) + static_cast<Index>(r)) =
          halves_[0].sums(21 + r, k) + halves_[1].sums(21 + r, k);
  dx_ = -(g_ + halves_[0].b + halves_[1].b);
}

bool ReducedSystem::factorize(const BundleState& state, double lambda) {
  lambda_ = lambda;
  linearize(state);
  auto& S = halves_[0].S;
  const auto& other = halves_[1].S;
  const Index n = g_.size();
  for (std::size_t k = 1; k < state.T_ck_c1.size(); ++k) {
    const Index row = rowOf(static_cast<int>(k));
    std::size_t i = 0;
    for (Index r = 0; r < 6; ++r)
      for (Index c = 0; c <= r; ++c, ++i) {
        const double h = halves_[0].sums(i, k) + halves_[1].sums(i, k);
        S(row + r, row + c) += h;
        if (r == c) own_(row + r) = h;
      }
  }
  for (Index c = 0; c < n; ++c) {
    const Index rows = reach_[static_cast<std::size_t>(c)] - c;
    S.col(c).segment(c, rows) += other.col(c).segment(c, rows);
  }
  S.diagonal().head(n) += lambda * own_;
  is_factorized_ = choleskyInPlace(S, reach_) &&
                   (S.diagonal().head(n).array().square() > kLeastInformation * own_.array()).all();
  return is_factorized_;
}

void ReducedSystem::substituteHalf(Half& half) {
  half.predicted = 0;
  for (const Group& group : half.groups) {
    const int first_free = std::max(group.first, 1);
    const Index rows = rowOf(group.last + 1) - rowOf(first_free);
    std::array<double, kColumns> z{};
    if (rows > 0)
      addTransposedProduct(z.data(), half.U.data() + group.at + 6 * (first_free - group.first),
                           static_cast<Index>(group.stride), rows,
                           static_cast<Index>(3 * (group.end - group.begin)),
                           dx_.data() + rowOf(first_free));
    for (std::size_t o = group.begin; o < group.end; ++o) {
      const auto& of = eliminated_[o];
      const auto& K = of.inverse;
      const Eigen::Map<const Eigen::Vector3d> y(of.y.data());
      const Eigen::Vector3d w = y + Eigen::Map<const Eigen::Vector3d>(&z[3 * (o - group.begin)]);
      Eigen::Vector3d& dm = at(step_.landmarks, order_[o]);
      dm = -Eigen::Vector3d(K[0] * w.x() + K[1] * w.y() + K[3] * w.z(), K[2] * w.y() + K[4] * w.z(),
                            K[5] * w.z());
      // g . dm = y . L^T dm = - y . w
      half.predicted +=
          y.dot(w) + dm.cwiseAbs2().dot(Eigen::Map<const Eigen::Vector3d>(of.damping.data()));
    }
  }
}

const ReducedSystem::Step& ReducedSystem::step() {
  dx_ = choleskySolve(halves_[0].S, std::move(dx_));
  for (std::size_t k = 1; k < step_.poses.size(); ++k)
    step_.poses[k] = dx_.segment<6>(rowOf(static_cast<int>(k)));
  step_.poses.front().setZero();
  forBothHalves([&](Half& half) { substituteHalf(half); });
  // With (H + lambda D) dx = -g the model's decrease is (lambda dx^T D dx -
  // g^T dx) / 2.
  step_.predicted = 0.5 * (lambda_ * dx_.cwiseAbs2().dot(own_) - g_.dot(dx_) +
                           halves_[0].predicted + halves_[1].predicted);
  return step_;
}

BundleCost ReducedSystem::costAt(const BundleState& state) {
  fillPoses(state.T_ck_c1, poses_);
  forBothHalves([&](Half& half) {
    half.residuals = {};
    for (const Group& group : half.groups)
      for (std::size_t o = group.begin; o < group.end; ++o) {
        const int j = order_[o];
        addResiduals(problem_->measured(static_cast<std::size_t>(j), at(state.landmarks, j)),
                     poses_.at(static_cast<std::size_t>(at(problem_->landmarks, j).first)),
                     poses_.stride(), half.residuals);
      }
  });
  return totalCost();
}

std::optional<JointCovariance> ReducedSystem::newestCovariance(int poses) const {
  if (!is_factorized_ || lambda_ > 0) return std::nullopt;
  const Index n = g_.size();
  const Index m = std::min<Index>(6 * poses, n);
  // The last rows of the factor hold the newest poses' information after all others.
  const JointCovariance L = halves_[0].S.block(n - m, n - m, m, m);
  const JointCovariance root =
      L.triangularView<Eigen::Lower>().solve(JointCovariance::Identity(m, m));
  return root.transpose() * root;
}

BundleSolution solveBundleWithSchur(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations,
                                    ReducedSystem& memory) {
  const bool gauss_newton = options.damping == DampingMethod::kGaussNewton;
  BundleSolution solution;
  solution.state = problem.start;
  BundleState candidate = problem.start;
  memory.setProblem(problem);
  BundleCost cost;
  double lambda = gauss_newton || problem.is_warm ? 0.0 : kInitialDamping;
  double growth = 2;
  for (; solution.iterations < iterations && !solution.converged; ++solution.iterations) {
    const bool regular = memory.factorize(solution.state, lambda);
    if (solution.iterations == 0) {
      cost = memory.cost();
      solution.initial_cost = cost.robust;
    }
    bool moved = false;
    if (regular) {
      const ReducedSystem::Step& step = memory.step();
      for (std::size_t k = 1; k < candidate.T_ck_c1.size(); ++k)
        candidate.T_ck_c1[k] = exp(step.poses[k]) * solution.state.T_ck_c1[k];
      for (std::size_t j = 0; j < candidate.landmarks.size(); ++j)
        candidate.landmarks[j] = solution.state.landmarks[j] + step.landmarks[j];
      const BundleCost candidate_cost = memory.costAt(candidate);
      const double change = cost.robust - candidate_cost.robust;
      solution.converged = isConverged(change, cost.robust, options.function_tolerance);
      moved = change > 0;
      if (moved) {
        std::swap(solution.state, candidate);
        cost = candidate_cost;
        const double quality = change / step.predicted;
        lambda *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * quality - 1.0, 3));
        growth = 2;
      }
    }
    if (moved || solution.converged) continue;
    if (gauss_newton) return solution;  // diverged, or singular
    lambda = std::max(lambda * growth, kInitialDamping);
    growth *= 2;
  }
  solution.final_cost = cost.robust;
  solution.rms = cost.rms;
  solution.usable = std::isfinite(cost.robust);
  return solution;
}

}  // namespace mvo
