// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/assignment/coral.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/assignment/assignment.hpp"
#include "kernels/relaxation.hpp"
#include "statistics.hpp"

namespace mvo {

namespace {

constexpr int kCheckEvery = 10;    // iterations
constexpr int kFirstBalance = 20;  // iterations, and twice as many each time after
constexpr double kPadding = 1e30;  // cost of labels that there are not

Eigen::Index padded(Eigen::Index n) { return (n + kDoubles - 1) / kDoubles * kDoubles; }

// The saddle point  min_u max_y,z  <rho, u> + sum_pq <y_pq, u_p - u_q> + sum_l <z_l, u(l)>
// with |y_pq| <= w_pq / 2,  z_l >= 0  and  sum_p z_l(p) <= gamma_l.
class PrimalDual {
 public:
  PrimalDual(const Energy& energy, const std::vector<int>& start)
      : labels_(energy.data.cols()),
        tracklets_(energy.data.rows()),
        rho_(Eigen::MatrixXd::Zero(padded(labels_), padded(tracklets_))),
        gamma_(Eigen::VectorXd::Zero(rho_.rows())),
        links_(Eigen::VectorXd::Ones(rho_.cols())),
        u_(Eigen::MatrixXd::Zero(rho_.rows(), rho_.cols())),
        z_(Eigen::MatrixXd::Zero(rho_.rows(), rho_.cols())),
        level_(Eigen::VectorXd::Zero(rho_.rows())),
        extrapolated_(rho_.rows(), rho_.cols()),
        scratch_(rho_.rows() * kDoubles) {
    rho_.topLeftCorner(labels_, tracklets_) = energy.data.transpose();
    rho_.bottomRows(rho_.rows() - labels_).setConstant(kPadding);
    gamma_.head(labels_) = energy.label_cost.cwiseMax(0.0);
    for (const auto& e : energy.edges) {
      if (e.p == e.q || e.weight <= 0) continue;
      ends_.insert(ends_.end(), {e.p, e.q});
      half_weight_.push_back(0.5 * e.weight);
      links_[e.p] += 1;
      links_[e.q] += 1;
    }
    y_.setZero(rho_.rows(), static_cast<Eigen::Index>(half_weight_.size()));
    const double scale = residualScale();
    balance_ = 0.1 * scale;
    startFrom(start, scale);
    remember();
  }

  void iterate() {
    const SaddlePoint point = saddlePoint();
    descendShares(point);
    ascendPrices(point, balance_);
  }

  // Lets the primal and the dual variables move alike, measured since the last call. Called
  // finitely often, it does not touch convergence.
  void rebalance() {
    const double du = (u_ - last_u_).norm();
    const double dual = std::hypot((y_ - last_y_).norm(), (z_ - last_z_).norm());
    if (du > 1e-9 && dual > 1e-9) {
      balance_ = std::sqrt(balance_ * dual / du);
      setStep();
    }
    remember();
  }

  double objective() const {
    const auto u = u_.topLeftCorner(labels_, tracklets_);
    double value = (rho_.topLeftCorner(labels_, tracklets_).array() * u.array()).sum();
    for (std::size_t i = 0; i < half_weight_.size(); ++i)
      value += half_weight_[i] * (u_.col(ends_[2 * i]) - u_.col(ends_[2 * i + 1])).lpNorm<1>();
    return value + gamma_.head(labels_).dot(u.rowwise().maxCoeff());
  }

  // The dual function: y and z are always feasible.
  double lowerBound() const {
    return cost_.topLeftCorner(labels_, tracklets_).colwise().minCoeff().sum();
  }

  // Inadmissible labels have no share: no dual variable gets near what they cost.
  std::vector<int> rounded() const {
    std::vector<int> assignment(tracklets_);
    for (Eigen::Index p = 0; p < tracklets_; ++p) u_.col(p).head(labels_).maxCoeff(&assignment[p]);
    return assignment;
  }

 private:
  // The dual variables as complementary slackness would have them if the start were the solution,
  // but not beyond what residuals differ by.
  void startFrom(const std::vector<int>& start, double scale) {
    Eigen::VectorXd support = Eigen::VectorXd::Zero(labels_);
    for (const int l : start) support[l] += 1;
    for (Eigen::Index p = 0; p < tracklets_; ++p) {
      const int l = start[p];
      u_(l, p) = 1;
      z_(l, p) = std::min(gamma_[l] / support[l], scale);
    }
    cost_ = rho_ + z_;
    for (std::size_t i = 0; i < half_weight_.size(); ++i) {
      const int p = ends_[2 * i];
      const int q = ends_[2 * i + 1];
      if (start[p] == start[q]) continue;
      auto y = y_.col(static_cast<Eigen::Index>(i));
      y[start[p]] = std::min(half_weight_[i], scale);
      y[start[q]] = -y[start[p]];
      cost_.col(p) += y;
      cost_.col(q) -= y;
    }
    setStep();
  }

  void setStep() { step_ = (balance_ * links_).cwiseInverse(); }

  SaddlePoint saddlePoint() {
    SaddlePoint point;
    point.width = static_cast<int>(rho_.rows());
    point.tracklets = static_cast<int>(tracklets_);
    point.edges = static_cast<int>(half_weight_.size());
    point.ends = ends_.data();
    point.half_weight = half_weight_.data();
    point.gamma = gamma_.data();
    point.rho = rho_.data();
    point.step = step_.data();
    point.u = u_.data();
    point.extrapolated = extrapolated_.data();
    point.y = y_.data();
    point.z = z_.data();
    point.level = level_.data();
    point.cost = cost_.data();
    point.scratch = scratch_.data();
    return point;
  }

  // Median of what the admissible labels cost above a tracklet's best.
  double residualScale() const {
    std::vector<double> excess;
    for (Eigen::Index p = 0; p < tracklets_; ++p) {
      const double best = rho_.col(p).minCoeff();
      for (Eigen::Index l = 0; l < labels_; ++l)
        if (rho_(l, p) > best && rho_(l, p) < Energy::kInadmissible)
          excess.push_back(rho_(l, p) - best);
    }
    return excess.empty() ? 1 : median(std::move(excess));
  }

  void remember() {
    last_u_ = u_;
    last_y_ = y_;
    last_z_ = z_;
  }

  Eigen::Index labels_;
  Eigen::Index tracklets_;
  std::vector<int> ends_;  // two tracklets per edge, without edges that cost nothing
  std::vector<double> half_weight_;
  Eigen::MatrixXd rho_;  // labels x tracklets, both padded
  Eigen::VectorXd gamma_;
  Eigen::VectorXd links_;  // per tracklet: edges, and one for the label costs
  Eigen::VectorXd step_;
  Eigen::MatrixXd u_;     // labels x tracklets
  Eigen::MatrixXd y_;     // labels x edges
  Eigen::MatrixXd z_;     // labels x tracklets
  Eigen::MatrixXd cost_;  // rho + K^T (y, z)
  Eigen::VectorXd level_;
  Eigen::MatrixXd extrapolated_;
  Eigen::VectorXd scratch_;
  Eigen::MatrixXd last_u_, last_y_, last_z_;
  double balance_ = 1;  // dual step over primal step
};

}  // namespace

Relaxation solveRelaxation(const Energy& energy, std::vector<int> start,
                           const CoralOptions& options) {
  Relaxation best;
  best.energy = energy.evaluate(start);
  best.objective = best.energy;
  if (start.empty()) return best;
  best.lower_bound = -std::numeric_limits<double>::infinity();
  PrimalDual problem(energy, start);
  best.assignment = std::move(start);
  int next_balance = kFirstBalance;
  while (best.iterations < options.max_iterations) {
    problem.iterate();
    ++best.iterations;
    if (best.iterations % kCheckEvery != 0 && best.iterations != options.max_iterations) continue;
    std::vector<int> rounded = problem.rounded();
    const double value = energy.evaluate(rounded);
    if (value < best.energy) {
      best.energy = value;
      best.assignment = std::move(rounded);
    }
    best.objective = problem.objective();
    best.lower_bound = std::max(best.lower_bound, problem.lowerBound());
    const double gap = std::min(best.objective, best.energy) - best.lower_bound;
    if (gap <= options.tolerance * std::abs(best.energy)) break;
    if (best.iterations != next_balance) continue;
    problem.rebalance();
    next_balance *= 2;
  }
  return best;
}

std::vector<int> relaxLabels(const Energy& energy, std::vector<int> assignment,
                             const CoralOptions& options) {
  return solveRelaxation(energy, std::move(assignment), options).assignment;
}

}  // namespace mvo
