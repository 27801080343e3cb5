// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F's normal equations with the landmarks eliminated (Schur), dense in the poses, and the back
// end that minimises with them.
#pragma once

#include <array>
#include <vector>

#include "engine/batch/bundle_problem.hpp"

namespace mvo {

/// (H + lambda diag H) dx = -g over all poses but the first and all landmarks, H and g weighted by
/// the robust loss, as Ceres does for Cauchy's. A memory for one problem after another: its storage
/// grows to the largest. Sums are split in two halves whatever the number of threads.
class ReducedSystem {
 public:
  /// The problem must stay until the next one is set.
  void setProblem(const BundleProblem& problem);

  /// Linearises at a state, eliminates the landmarks and factorises what is left; false if that is
  /// singular.
  bool factorize(const BundleState& state, double lambda);
  /// Of the state of the last factorisation.
  BundleCost cost() const { return cost_; }

  struct Step {
    std::vector<Vector6d> poses;  ///< left perturbations; the first is zero
    std::vector<Eigen::Vector3d> landmarks;
    double predicted = 0;  ///< decrease of the quadratic model
  };
  /// dx, once after a factorisation. Valid until the next.
  const Step& step();
  /// Of a state of the problem, not that of the factorisation.
  BundleCost costAt(const BundleState& state);

  /// Joint covariance of the newest poses but the held first, at most two, landmarks and other
  /// poses marginalised, oldest first. None if the last factorisation failed or was damped.
  std::optional<JointCovariance> newestCovariance(int poses) const;

 private:
  // Landmarks whose part of the Schur complement is subtracted in one pass over memory.
  struct Group {
    std::size_t begin = 0;  // in order_
    std::size_t end = 0;
    int first = 0;  // pose
    int last = 0;
    std::size_t at = 0;      // of its factor U in Half::U, rows from its first pose on
    std::size_t stride = 0;  // of U
  };
  // A landmark, eliminated: V, damped, = L L^T.
  struct Eliminated {
    std::array<double, 6> inverse{};  // L^-1, row by row
    std::array<double, 3> y{};        // L^-1 g
    std::array<double, 3> damping{};  // lambda diag V
  };
  // What one half of the landmarks adds to the poses.
  struct Half {
    std::vector<Group> groups;
    PoseTable sums;     // H and g
    Eigen::MatrixXd S;  // - sum of U U^T, lower triangle
    Eigen::VectorXd b;  // - sum of U y
    std::vector<double> U;
    std::vector<double> coupling;    // of one landmark
    std::vector<Eigen::Index> ends;  // of one group's columns, see subtractGram
    ResidualSums residuals;
    double predicted = 0;
  };

  void sortLandmarks();
  void setGroups(std::size_t begin, std::size_t end, Half& half);
  template <class Function>
  void forBothHalves(const Function& function);
  void linearize(const BundleState& state);
  void eliminateHalf(const BundleState& state, double lambda, Half& half);
  void eliminateGroup(const BundleState& state, double lambda, const Group& group, Half& half);
  void substituteHalf(Half& half);
  BundleCost totalCost() const;

  const BundleProblem* problem_ = nullptr;
  bool parallel_ = false;
  std::vector<int> order_;           // of landmarks: by first and last pose
  std::vector<Eigen::Index> reach_;  // see choleskyInPlace
  std::array<Half, 2> halves_;
  std::vector<Eliminated> eliminated_;  // parallel to order_
  PoseTable poses_;
  Eigen::VectorXd g_;
  Eigen::VectorXd own_;  // diagonal of H
  Eigen::VectorXd dx_;
  Step step_;
  BundleCost cost_;
  double lambda_ = 0;
  bool is_factorized_ = false;
};

/// Minimises J from problem.start by Levenberg-Marquardt (or plain Gauss-Newton) steps in the
/// memory given. The result
/// does not depend on the number of threads.
BundleSolution solveBundleWithSchur(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations,
                                    ReducedSystem& memory);

}  // namespace mvo
