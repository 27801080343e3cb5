// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The batch of III-F in the form both back ends minimise: whitened residuals, and landmarks as
// inverse depth in the camera of one of their own observations. Inverse depth is proportional to
// disparity, so a point at infinity, or with a disparity that noise has made negative, is an
// ordinary point here.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/batch/bundle_adjustment.hpp"
#include "kernels/landmark.hpp"
#include "mvo/se3.hpp"

namespace mvo {

/// (a, b, rho) = (x, y, 1) / z of a point in its anchor camera, mapped to homogeneous coordinates
/// in C_1: T_c1_anchor (a, b, 1, rho). The anchor's pose is that of the start, held fixed.
struct LandmarkChart {
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();  ///< d(x, y, z)/d(a, b, rho)
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  /// (x, y, z) in C_1 of the homogeneous point whose fourth coordinate is rho = m.z().
  Eigen::Vector3d point(const Eigen::Vector3d& m) const { return origin + B * m; }
};

/// What is estimated.
struct BundleState {
  std::vector<Eigen::Isometry3d> T_ck_c1;  ///< the first is held
  std::vector<Eigen::Vector3d> landmarks;  ///< (a, b, rho) in each landmark's chart
};

/// A batch that can be estimated, and its start.
struct BundleProblem {
  /// Seen first and last in poses [first, first + span); span = 0: never.
  struct Landmark {
    LandmarkChart chart;
    int first = 0;
    int span = 0;           ///< in poses
    int block = 0;          ///< the first of its blocks
    bool is_known = false;  ///< by an earlier batch
    std::size_t blocks() const {
      return (static_cast<std::size_t>(span) + kDoubles - 1) / kDoubles;
    }
  };

  Eigen::Vector3d gain = Eigen::Vector3d::Zero();  ///< h = gain o (x, y, w)/z
  double robust_scale = 0;                         ///< Cauchy's width; 0 = squares
  bool is_warm = false;                            ///< some landmarks are known
  std::vector<Landmark> landmarks;
  std::vector<MeasurementBlock> blocks;  ///< by landmark, one lane per pose of its span
  int measurements = 0;
  BundleState start;

  /// Calls visit(pose, h) for a landmark's measurements in order; h is whitened: ((u - cu)/s_u,
  /// (v - cv)/s_v, d/s_d).
  template <class Visit>
  void forEachMeasurement(const Landmark& landmark, const Visit& visit) const {
    for (int i = 0; i < landmark.span; ++i) {
      const auto& block =
          blocks[static_cast<std::size_t>(landmark.block) + static_cast<std::size_t>(i / kDoubles)];
      const auto lane = static_cast<std::size_t>(i % kDoubles);
      if (block.seen[lane] == 0) continue;
      visit(landmark.first + i, Eigen::Vector3d(block.u[lane], block.v[lane], block.d[lane]));
    }
  }
  /// For the kernels: landmark j at m.
  LandmarkMeasurements measured(std::size_t j, const Eigen::Vector3d& m) const;
};

/// Of the left perturbations of one or two poses, the older first.
using JointCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

/// How a back end ended; its state is the best it has seen.
struct BundleSolution {
  BundleState state;
  bool usable = false;     ///< finite, and not diverged
  bool converged = false;  ///< by tolerance
  int iterations = 0;
  double initial_cost = 0;  ///< J, robustified
  double final_cost = 0;    ///< J, robustified
  double rms = 0;           ///< of the whitened residuals
};

/// None if the batch is empty, not finite or out of order, or leaves a pose without constraint: too
/// few observations, observations on a line, frames that no landmark connects. `memory` is a
/// problem that has served, for its storage.
std::optional<BundleProblem> makeBundleProblem(const Bundle& bundle, const StereoCamera& camera,
                                               const NoiseOptions& noise,
                                               const BundleAdjustmentOptions& options,
                                               BundleProblem memory = {});

/// The newest pose whose own observations do not constrain it: too few of them, or all on a line.
std::optional<int> newestWeakPose(const Bundle& bundle, const StereoCamera& camera,
                                  const NoiseOptions& noise, int min_observations);

/// Cauchy's weight of a squared whitened residual, 1 for squares.
inline double robustWeight(double squared, double scale) {
  return scale > 0 ? 1.0 / (1.0 + squared / (scale * scale)) : 1.0;
}

/// What a state's residuals add up to.
struct BundleCost {
  double robust = 0;  ///< J, robustified
  double rms = 0;     ///< of the whitened residuals
};

/// Of sums over all residuals of a problem.
BundleCost bundleCost(const BundleProblem& problem, const ResidualSums& sums);
BundleCost bundleCost(const BundleProblem& problem, const BundleState& state);

/// Poses as the kernels read them.
void fillPoses(const std::vector<Eigen::Isometry3d>& T_ck_c1, PoseTable& table);

/// A whitened residual e = h - s(T p) and its Jacobians.
struct BundleResidual {
  Eigen::Vector3d e;
  Eigen::Matrix<double, 3, 6> J_pose;  ///< by the left perturbation of T_ck_c1
  Eigen::Matrix3d J_landmark;          ///< by (a, b, rho)
};

/// Whether a step's change of the cost ends the iteration: by the tolerance, or because it is
/// rounding.
inline bool isConverged(double change, double cost, double function_tolerance) {
  constexpr double relative = 1e-12;
  constexpr double absolute = 1e-16;  // residuals of 1e-8 standard deviations
  return std::abs(change) <= std::max(function_tolerance, relative) * cost + absolute;
}

/// Levenberg-Marquardt's first damping, relative to the diagonal; more would slow the weak
/// directions, in which all later poses move together. A warm start is not damped before a step has
/// failed.
constexpr double kInitialDamping = 1e-6;

/// e alone, for a point (x, y, z, rho) in C_1.
template <class Rotation, class Translation>
inline Eigen::Vector3d whitenedResidual(const Eigen::Vector3d& gain, const Rotation& C,
                                        const Translation& t, const Eigen::Vector3d& p, double rho,
                                        const Eigen::Vector3d& h) {
  const Eigen::Vector3d q = C * p + rho * t;
  const double inverse = 1.0 / (q.z() > kLeastDepth ? q.z() : kLeastDepth);
  return {h.x() - gain.x() * q.x() * inverse, h.y() - gain.y() * q.y() * inverse,
          h.z() - gain.z() * rho * inverse};
}

/// e and its Jacobians.
template <class Rotation, class Translation>
inline BundleResidual linearizeResidual(const Eigen::Vector3d& gain, const Rotation& C,
                                        const Translation& t, const LandmarkChart& chart,
                                        const Eigen::Vector3d& m, const Eigen::Vector3d& h) {
  const double rho = m.z();
  const Eigen::Vector3d q = C * chart.point(m) + rho * t;
  const bool in_front = q.z() > kLeastDepth;
  const double inverse = 1.0 / (in_front ? q.z() : kLeastDepth);
  const double du = gain.x() * inverse;
  const double dv = gain.y() * inverse;
  const double dd = gain.z() * inverse;
  const double by_depth = in_front ? inverse : 0.0;

  BundleResidual out;
  out.e = {h.x() - du * q.x(), h.y() - dv * q.y(), h.z() - dd * rho};
  // D = de/dq: (-du, 0, Du), (0, -dv, Dv), (0, 0, Dd).
  const double Du = du * q.x() * by_depth;
  const double Dv = dv * q.y() * by_depth;
  const double Dd = dd * rho * by_depth;
  // J_pose = D (q, rho)^odot = D [rho 1, -q^].
  out.J_pose << -rho * du, 0, rho * Du, Du * q.y(), -du * q.z() - Du * q.x(), du * q.y(),  //
      0, -rho * dv, rho * Dv, dv * q.z() + Dv * q.y(), -Dv * q.x(), -dv * q.x(),           //
      0, 0, rho * Dd, Dd * q.y(), -Dd * q.x(), 0;
  // J_landmark = D (C B + t e_3^T) + (0, 0, -dd)^T e_3^T.
  Eigen::Matrix3d A = C * chart.B;
  A.col(2) += t;
  out.J_landmark.row(0) = Du * A.row(2) - du * A.row(0);
  out.J_landmark.row(1) = Dv * A.row(2) - dv * A.row(1);
  out.J_landmark.row(2) = Dd * A.row(2);
  out.J_landmark(2, 2) -= dd;
  return out;
}

}  // namespace mvo
