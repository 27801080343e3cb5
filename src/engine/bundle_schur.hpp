// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F's normal equations with the landmarks eliminated (Schur), dense in the poses, and the back
// end that minimises with them.
#pragma once

#include <array>
#include <vector>

#include "bundle_problem.hpp"

namespace mvo {

/// (H + lambda D) dx = -g over all poses but the first and all landmarks, H and g weighted by the
/// robust loss, as Ceres does for Cauchy's; D is the diagonal of the poses' part of H (landmarks
/// are well known by themselves). A memory for one problem after another: its storage grows to the
/// largest. Sums are split in two halves whatever the number of threads.
class ReducedSystem {
 public:
  /// The problem must stay until the next one is set.
  void setProblem(const BundleProblem& problem);

  /// Linearises at a state, eliminates the landmarks and factorises what is left; false if that is
  /// singular.
  bool factorize(const BundleState& state, double lambda);
  /// Takes g of a state and keeps all else of the last factorisation.
  void keepFactor(const BundleState& state);
  /// Of the state of either.
  BundleCost cost() const { return cost_; }

  struct Step {
    std::vector<Vector6d> poses;  ///< left perturbations; the first is zero
    std::vector<Eigen::Vector3d> landmarks;
    double predicted = 0;  ///< decrease of the quadratic model
  };
  /// dx, once after either. Valid until the next.
  const Step& step();
  /// Of a state of the problem, not that of the factorisation.
  BundleCost costAt(const BundleState& state);

  /// Joint covariance of the newest poses but the held first, at most two, landmarks and other
  /// poses marginalised, oldest first, undamped, at the state of the last factorisation and once
  /// after it. None if it is singular there.
  std::optional<JointCovariance> newestCovariance(int poses);

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
  // A landmark, eliminated: V = L L^T.
  struct Eliminated {
    std::array<double, 6> inverse{};  // L^-1, row by row
    std::array<double, 3> y{};        // L^-1 g
  };
  // What one half of the landmarks adds to the poses.
  struct Half {
    std::vector<Group> groups;
    PoseTable sums;     // H and g
    Eigen::MatrixXd S;  // - sum of U U^T, lower triangle; then the factor, or the matrix undamped
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
  void linearize(const BundleState& state, bool is_kept);
  void eliminateHalf(const BundleState& state, bool is_kept, Half& half);
  void eliminateGroup(const BundleState& state, const Group& group, bool is_kept, Half& half);
  bool isRegular(const Eigen::MatrixXd& L) const;
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
/// memory given; damped steps keep the last factorisation while the cost hardly changes. The result
/// does not depend on the number of threads.
BundleSolution solveBundleWithSchur(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations,
                                    ReducedSystem& memory);

}  // namespace mvo
