// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/bundle_ceres.hpp"

#include <ceres/ceres.h>

#include <array>
#include <deque>
#include <memory>

#if CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1)
#define MVO_CERES_HAS_MANIFOLD
#endif

namespace mvo {

namespace {

constexpr int kPoseSize = 12;  // C column by column, then the translation
using PoseBlock = std::array<double, kPoseSize>;
using PoseMatrix = Eigen::Matrix<double, 3, 4>;

// exp(eps^) T.
void perturb(const double* T, const double* eps, double* result) {
  const Eigen::Isometry3d delta = exp(Eigen::Map<const Vector6d>(eps));
  const Eigen::Map<const PoseMatrix> from(T);
  Eigen::Map<PoseMatrix> to(result);
  to.leftCols<3>() = delta.linear() * from.leftCols<3>();
  to.col(3) = delta * Eigen::Vector3d(from.col(3));
}

// The cost functions give their Jacobian by the left perturbation in the first six columns; this is
// the derivative of those by the perturbation, in place of that of the twelve numbers.
using LiftMatrix = Eigen::Matrix<double, kPoseSize, 6, Eigen::RowMajor>;
using LandmarkMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

#ifdef MVO_CERES_HAS_MANIFOLD
class LeftPerturbation final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return kPoseSize; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* result) const override {
    perturb(x, delta, result);
    return true;
  }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<LiftMatrix>(jacobian).setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* difference) const override {
    const auto pose = [](const double* values) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.matrix().topRows<3>() = Eigen::Map<const PoseMatrix>(values);
      return T;
    };
    Eigen::Map<Vector6d>{difference} = log(pose(y) * pose(x).inverse());
    return true;
  }
  bool MinusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, kPoseSize, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
};
#else
class LeftPerturbation final : public ceres::LocalParameterization {
 public:
  int GlobalSize() const override { return kPoseSize; }
  int LocalSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* result) const override {
    perturb(x, delta, result);
    return true;
  }
  bool ComputeJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<LiftMatrix>(jacobian).setIdentity();
    return true;
  }
};
#endif

class StereoCost final : public ceres::SizedCostFunction<3, kPoseSize, 3> {
 public:
  StereoCost(const Eigen::Vector3d& gain, const LandmarkChart& chart, const Eigen::Vector3d& h)
      : gain_(gain), chart_(chart), h_(h) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const PoseMatrix> T(parameters[0]);
    const Eigen::Vector3d m = Eigen::Map<const Eigen::Vector3d>(parameters[1]);
    Eigen::Map<Eigen::Vector3d> e(residuals);
    if (jacobians == nullptr) {
      e = whitenedResidual(gain_, T.leftCols<3>(), T.col(3), chart_.point(m), m.z(), h_);
      return true;
    }
    const auto linear = linearizeResidual(gain_, T.leftCols<3>(), T.col(3), chart_, m, h_);
    e = linear.e;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, kPoseSize, Eigen::RowMajor>> J(jacobians[0]);
      J.leftCols<6>() = linear.J_pose;
      J.rightCols<kPoseSize - 6>().setZero();
    }
    if (jacobians[1] != nullptr) Eigen::Map<LandmarkMatrix>{jacobians[1]} = linear.J_landmark;
    return true;
  }

 private:
  const Eigen::Vector3d& gain_;
  const LandmarkChart& chart_;
  Eigen::Vector3d h_;
};

// Ends by the relative change of the cost, after the step was taken (Ceres' own test drops that
// step), and ends Gauss-Newton at the first step that raises the cost.
class EndOfIterations final : public ceres::IterationCallback {
 public:
  explicit EndOfIterations(const BundleAdjustmentOptions& options)
      : tolerance_(options.function_tolerance),
        damped_(options.damping == DampingMethod::kLevenbergMarquardt) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    const double change = summary.cost_change;
    const double before = summary.step_is_successful ? summary.cost + change : summary.cost;
    converged_ = summary.step_is_valid && isConverged(change, before, tolerance_);
    diverged_ = !converged_ && !damped_ && !summary.step_is_successful;
    return converged_ || diverged_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  bool converged() const { return converged_; }
  bool diverged() const { return diverged_; }

 private:
  double tolerance_;
  bool damped_;
  bool converged_ = false;
  bool diverged_ = false;
};

ceres::Solver::Options solverOptions(const BundleAdjustmentOptions& options, int iterations) {
  ceres::Solver::Options out;
  out.linear_solver_type = ceres::DENSE_SCHUR;
  out.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  out.max_num_iterations = iterations;
  out.num_threads = 1;
  out.logging_type = ceres::SILENT;
  out.function_tolerance = 0;
  out.gradient_tolerance = 1e-14;
  out.parameter_tolerance = 1e-15;
  // Ceres knows plain Gauss-Newton as a trust region without a bound.
  const bool damped = options.damping == DampingMethod::kLevenbergMarquardt;
  out.initial_trust_region_radius = damped ? 1.0 / kInitialDamping : 1e16;
  return out;
}

}  // namespace

BundleSolution solveBundleWithCeres(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations) {
  BundleSolution solution;
  solution.state = problem.start;
  auto& landmarks = solution.state.landmarks;
  std::vector<PoseBlock> poses(problem.start.T_ck_c1.size());
  for (std::size_t k = 0; k < poses.size(); ++k)
    Eigen::Map<PoseMatrix>(poses[k].data()) = problem.start.T_ck_c1[k].matrix().topRows<3>();

  std::deque<StereoCost> costs;
  std::unique_ptr<ceres::LossFunction> loss;
  if (problem.robust_scale > 0) loss = std::make_unique<ceres::CauchyLoss>(problem.robust_scale);

  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  ceres::Problem ceres_problem(ownership);
  ceres::Solver::Options solver = solverOptions(options, iterations);
  solver.linear_solver_ordering.reset(new ceres::ParameterBlockOrdering);
  auto& ordering = *solver.linear_solver_ordering;
  auto* const left_perturbation = new LeftPerturbation;  // the problem owns it
  for (auto& pose : poses) {
    ceres_problem.AddParameterBlock(pose.data(), kPoseSize, left_perturbation);
    ordering.AddElementToGroup(pose.data(), 1);
  }
  ceres_problem.SetParameterBlockConstant(poses.front().data());
  for (std::size_t j = 0; j < landmarks.size(); ++j) {
    const auto& landmark = problem.landmarks[j];
    if (landmark.span == 0) continue;
    ceres_problem.AddParameterBlock(landmarks[j].data(), 3);
    ordering.AddElementToGroup(landmarks[j].data(), 0);
    problem.forEachMeasurement(landmark, [&](int pose, const Eigen::Vector3d& h) {
      costs.emplace_back(problem.gain, landmark.chart, h);
      ceres_problem.AddResidualBlock(&costs.back(), loss.get(),
                                     poses[static_cast<std::size_t>(pose)].data(),
                                     landmarks[j].data());
    });
  }

  EndOfIterations end(options);
  solver.callbacks.push_back(&end);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres_problem, &summary);

  for (std::size_t k = 1; k < poses.size(); ++k)
    solution.state.T_ck_c1[k].matrix().topRows<3>() = Eigen::Map<const PoseMatrix>(poses[k].data());
  solution.initial_cost = bundleCost(problem, problem.start).robust;
  const BundleCost cost = bundleCost(problem, solution.state);
  solution.final_cost = cost.robust;
  solution.rms = cost.rms;
  solution.converged = end.converged() || summary.termination_type == ceres::CONVERGENCE;
  const double rise = solution.final_cost - solution.initial_cost;
  const bool is_lower = rise <= 0 || isConverged(rise, solution.initial_cost, 0);
  solution.usable = summary.IsSolutionUsable() && !end.diverged() && is_lower;
  solution.iterations = static_cast<int>(summary.iterations.size()) - 1;
  return solution;
}

}  // namespace mvo
