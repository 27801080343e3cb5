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

#include "mvo/engine/bundle_adjustment.hpp"
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
  struct Landmark {
    LandmarkChart chart;
    int begin = 0;  ///< of its measurements
    int end = 0;
  };
  struct Measurement {
    int pose = 0;
    Eigen::Vector3d h = Eigen::Vector3d::Zero();  ///< ((u - cu)/s_u, (v - cv)/s_v, d/s_d)
  };

  Eigen::Vector3d gain = Eigen::Vector3d::Zero();  ///< h = gain o (x, y, w)/z
  double robust_scale = 0;                         ///< Cauchy's width; 0 = squares
  std::vector<Landmark> landmarks;
  std::vector<Measurement> measurements;  ///< by landmark
  BundleState start;
};

/// How a back end ended; its state is the best it has seen.
struct BundleSolution {
  BundleState state;
  bool usable = false;     ///< finite, and not diverged
  bool converged = false;  ///< by tolerance
  int iterations = 0;
  double initial_cost = 0;  ///< J, robustified
  double final_cost = 0;    ///< J, robustified
};

/// None if the batch is empty, not finite or out of order, or leaves a pose without constraint: too
/// few observations, observations on a line, frames that no landmark connects.
std::optional<BundleProblem> makeBundleProblem(const Batch& batch, const StereoCamera& camera,
                                               const NoiseOptions& noise,
                                               const BundleAdjustmentOptions& options);

/// Half the robustified cost of one squared whitened residual.
double robustCost(double squared, double scale);

/// Cauchy's weight of a squared whitened residual, 1 for squares.
inline double robustWeight(double squared, double scale) {
  return scale > 0 ? 1.0 / (1.0 + squared / (scale * scale)) : 1.0;
}

/// J, robustified.
double bundleCost(const BundleProblem& problem, const BundleState& state);

/// Root mean square of the whitened residuals.
double bundleRms(const BundleProblem& problem, const BundleState& state);

/// A whitened residual e = h - s(T p) and its Jacobians.
struct BundleResidual {
  Eigen::Vector3d e;
  Eigen::Matrix<double, 3, 6> J_pose;  ///< by the left perturbation of T_ck_c1
  Eigen::Matrix3d J_landmark;          ///< by (a, b, rho)
};

/// Depth below which a point counts as lying there, in units of its anchor's depth: a point that
/// passes behind a camera keeps a finite, large residual.
constexpr double kLeastDepth = 0.01;

/// Whether a step's change of the cost ends the iteration: by the tolerance, or because it is
/// rounding.
inline bool isConverged(double change, double cost, double function_tolerance) {
  constexpr double relative = 1e-12;
  constexpr double absolute = 1e-16;  // residuals of 1e-8 standard deviations
  return std::abs(change) <= std::max(function_tolerance, relative) * cost + absolute;
}

/// Levenberg-Marquardt's first damping, relative to the diagonal: batches mostly start warm, and
/// more would slow the weak directions, in which all later poses move together.
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
