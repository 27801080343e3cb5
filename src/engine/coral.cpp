// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/coral.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mvo/engine/assignment.hpp"

namespace mvo {

namespace {

constexpr int kCheckEvery = 20;  // iterations

// t >= `low` such that the parts of x above t sum to `sum`; those above `low` sum to at least that.
// Newton's method on a convex piecewise linear function.
template <class Array>
double waterLevel(const Array& x, double sum, double low) {
  Eigen::Index above = x.size() + 1;
  while (true) {
    const Eigen::Index count = (x > low).count();
    if (count >= above || count == 0) return low;  // settled, up to rounding
    above = count;
    low += ((x - low).max(0.0).sum() - sum) / static_cast<double>(count);
  }
}

// The saddle point  min_u max_y,z  <rho, u> + sum_pq <y_pq, u_p - u_q> + sum_l <z_l, u(l)>
// with |y_pq| <= w_pq / 2,  z_l >= 0  and  sum_p z_l(p) <= gamma_l.
class PrimalDual {
 public:
  PrimalDual(const Energy& energy, const std::vector<int>& start)
      : energy_(energy),
        rho_(energy.data.transpose()),
        links_(Eigen::VectorXd::Ones(energy.tracklets())),
        u_(Eigen::MatrixXd::Zero(rho_.rows(), rho_.cols())),
        z_(Eigen::MatrixXd::Zero(rho_.cols(), rho_.rows())),
        balance_(0.1 * residualScale()) {
    for (const auto& e : energy.edges)
      if (e.p != e.q && e.weight > 0) edges_.push_back(e);
    y_.setZero(rho_.rows(), static_cast<Eigen::Index>(edges_.size()));
    for (const auto& e : edges_) {
      links_[e.p] += 1;
      links_[e.q] += 1;
    }
    for (int p = 0; p < energy.tracklets(); ++p) u_(start[p], p) = 1;
    remember();
  }

  void iterate() {
    Eigen::MatrixXd extrapolated = -u_;
    const Eigen::MatrixXd slope = reducedCost();
    for (Eigen::Index p = 0; p < u_.cols(); ++p) {
      auto u = u_.col(p).array();
      u -= slope.col(p).array() / (balance_ * links_[p]);
      u = (u - waterLevel(u, 1, u.maxCoeff() - 1)).max(0.0);
    }
    extrapolated += 2 * u_;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto& e = edges_[i];
      auto y = y_.col(static_cast<Eigen::Index>(i)).array();
      y += 0.5 * balance_ * (extrapolated.col(e.p) - extrapolated.col(e.q)).array();
      y = y.max(-0.5 * e.weight).min(0.5 * e.weight);
    }
    for (Eigen::Index l = 0; l < z_.cols(); ++l) {
      const double gamma = energy_.label_cost[l];
      if (gamma <= 0) continue;
      auto z = z_.col(l).array();
      z = (z + balance_ * extrapolated.row(l).transpose().array()).max(0.0);
      if (z.sum() > gamma) z = (z - waterLevel(z, gamma, 0)).max(0.0);
    }
  }

  // Lets the primal and the dual variables move alike, measured since the last call. Called
  // finitely often, it does not touch convergence.
  void rebalance() {
    const double du = (u_ - last_u_).norm();
    const double dual = std::hypot((y_ - last_y_).norm(), (z_ - last_z_).norm());
    if (du > 1e-9 && dual > 1e-9) balance_ = std::sqrt(balance_ * dual / du);
    remember();
  }

  double objective() const {
    double value = (rho_.array() * u_.array()).sum();
    for (const auto& e : edges_) value += 0.5 * e.weight * (u_.col(e.p) - u_.col(e.q)).lpNorm<1>();
    return value + energy_.label_cost.dot(u_.rowwise().maxCoeff());
  }

  // The dual function: y and z are always feasible.
  double lowerBound() const { return reducedCost().colwise().minCoeff().sum(); }

  // Inadmissible labels have no share: no dual variable gets near what they cost.
  std::vector<int> rounded() const {
    std::vector<int> assignment(u_.cols());
    for (Eigen::Index p = 0; p < u_.cols(); ++p) u_.col(p).maxCoeff(&assignment[p]);
    return assignment;
  }

 private:
  // rho + K^T (y, z)
  Eigen::MatrixXd reducedCost() const {
    Eigen::MatrixXd cost = rho_ + z_.transpose();
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto y = y_.col(static_cast<Eigen::Index>(i));
      cost.col(edges_[i].p) += y;
      cost.col(edges_[i].q) -= y;
    }
    return cost;
  }

  // Median of what the admissible labels cost above a tracklet's best.
  double residualScale() const {
    std::vector<double> excess;
    for (Eigen::Index p = 0; p < rho_.cols(); ++p) {
      const double best = rho_.col(p).minCoeff();
      for (Eigen::Index l = 0; l < rho_.rows(); ++l)
        if (rho_(l, p) > best && rho_(l, p) < Energy::kInadmissible)
          excess.push_back(rho_(l, p) - best);
    }
    if (excess.empty()) return 1;
    const auto middle = excess.begin() + static_cast<std::ptrdiff_t>(excess.size() / 2);
    std::nth_element(excess.begin(), middle, excess.end());
    return *middle;
  }

  void remember() {
    last_u_ = u_;
    last_y_ = y_;
    last_z_ = z_;
  }

  const Energy& energy_;
  std::vector<Energy::Edge> edges_;  // without those that cost nothing
  Eigen::MatrixXd rho_;              // labels x tracklets
  Eigen::VectorXd links_;            // per tracklet: edges, and one for the label costs
  Eigen::MatrixXd u_;                // labels x tracklets
  Eigen::MatrixXd y_;                // labels x edges
  Eigen::MatrixXd z_;                // tracklets x labels
  Eigen::MatrixXd last_u_, last_y_, last_z_;
  double balance_;  // dual step over primal step
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
  int next_balance = kCheckEvery;
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
