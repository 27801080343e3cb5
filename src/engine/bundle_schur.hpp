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

/// (H + lambda diag H) dx = -g over all poses but the first and all landmarks, H and g weighted by
/// the robust loss, as Ceres does for Cauchy's. Keeps its memory between iterations. Sums are split
/// in two halves whatever the number of threads.
class ReducedSystem {
 public:
  /// The problem must outlive this.
  explicit ReducedSystem(const BundleProblem& problem);

  /// Sets H and g at a state.
  void linearize(const BundleState& state);
  /// Eliminates the landmarks and factorises what is left; false if that is singular.
  bool factorize(double lambda);

  struct Step {
    std::vector<Vector6d> poses;  ///< left perturbations; the first is zero
    std::vector<Eigen::Vector3d> landmarks;
    double predicted = 0;  ///< decrease of the quadratic model
  };
  /// dx of the last factorisation.
  Step step() const;
  /// Joint covariance of the newest poses but the held first, landmarks and other poses
  /// marginalised, oldest first; needs factorize(0).
  Eigen::MatrixXd newestCovariance(int poses) const;

 private:
  using Coupling = Eigen::Matrix<double, 6, 3>;
  // What one half of the landmarks adds to the poses.
  struct Half {
    std::size_t begin = 0;  // in order_
    std::size_t end = 0;
    std::vector<Matrix6d> H;
    std::vector<Vector6d> g;
    Eigen::MatrixXd S;  // - sum of U U^T, lower triangle
    Eigen::VectorXd b;  // - sum of U y
    Eigen::MatrixXd U;  // of a group of landmarks
  };

  template <class Function>
  void forBothHalves(const Function& function);
  void linearizeHalf(const BundleState& state, Half& half);
  void eliminateHalf(double lambda, Half& half);

  const BundleProblem& problem_;
  bool parallel_;
  std::vector<int> order_;  // of landmarks: by first and last pose
  std::array<Half, 2> halves_;
  std::vector<Eigen::Matrix3d> V_;   // per landmark
  std::vector<Eigen::Vector3d> gl_;  // per landmark
  std::vector<Coupling> W_;          // per measurement
  std::vector<Matrix6d> H_;
  Eigen::VectorXd g_;
  Eigen::VectorXd b_;
  double lambda_ = 0;
};

/// Minimises J from problem.start by Levenberg-Marquardt (or plain Gauss-Newton) steps. The result
/// does not depend on the number of threads.
BundleSolution solveBundleWithSchur(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations);

}  // namespace mvo
