// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/common_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "statistics.hpp"

namespace mvo {

namespace {

using Slope = Eigen::Matrix<double, 2, 6>;  // d(u_l, v)/d(twist)

constexpr std::size_t kLeastPoints = 8;
constexpr int kIterations = 4;
constexpr double kLeastSpread = 0.1;   // what tracking itself is off by [px]
constexpr double kToDeviation = 0.85;  // from the median length of normal 2-vectors, sqrt(2 ln 2)
constexpr double kLoss = 2;            // where Cauchy's loss bends [spreads]
constexpr double kLeastDisparity = 0.05;  // farther points move as infinite ones do [px]
constexpr double kRidge = 1e-6;           // of what the points leave open

Slope slopeAt(const Eigen::Vector3d& y, const StereoCamera& camera) {
  const double u = (y.x() - camera.cu) / camera.fu;
  const double v = (y.y() - camera.cv) / camera.fv;
  const double w = std::max(y.x() - y.z(), kLeastDisparity) / camera.fu;  // baselines / depth
  Slope J;
  J << w, 0, -u * w, -u * v, 1 + u * u, -v, 0, w, -v * w, -1 - v * v, u * v, u;
  J.row(0) *= camera.fu;
  J.row(1) *= camera.fv;
  return J;
}

double spreadOf(const std::vector<double>& squares) {
  return std::max(kLeastSpread, kToDeviation * std::sqrt(median(squares)));
}

// What most points agree on roughly: a shift of the image.
Eigen::Vector2d commonShift(const std::vector<Eigen::Vector2d>& shifts) {
  std::vector<double> u;
  std::vector<double> v;
  for (const Eigen::Vector2d& s : shifts) {
    u.push_back(s.x());
    v.push_back(s.y());
  }
  return {median(std::move(u)), median(std::move(v))};
}

}  // namespace

std::optional<CommonMotion> CommonMotion::fit(const std::vector<FoundPoint>& points,
                                              const StereoCamera& camera) {
  if (points.size() < kLeastPoints) return std::nullopt;
  std::vector<Slope> slopes;
  std::vector<Eigen::Vector2d> shifts;
  for (const FoundPoint& p : points) {
    slopes.push_back(slopeAt(p.expected, camera));
    shifts.emplace_back(p.found - p.expected.head<2>());
  }
  const Eigen::Vector2d start = commonShift(shifts);
  std::vector<double> squares;
  squares.reserve(shifts.size());
  for (const Eigen::Vector2d& s : shifts) squares.push_back((s - start).squaredNorm());
  CommonMotion motion;
  motion.spread_ = spreadOf(squares);
  for (int i = 0; i < kIterations; ++i) {
    const double bend = kLoss * motion.spread_;
    Matrix6d H = kRidge * Matrix6d::Identity();
    Vector6d b = Vector6d::Zero();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double weight = 1 / (1 + squares[k] / (bend * bend));
      const Eigen::Matrix<double, 6, 2> weighted = weight * slopes[k].transpose();
      H += weighted * slopes[k];
      b += weighted * shifts[k];
    }
    const Eigen::LLT<Matrix6d> solver(H);
    motion.twist_ = solver.solve(b);
    for (std::size_t k = 0; k < points.size(); ++k)
      squares[k] = (shifts[k] - slopes[k] * motion.twist_).squaredNorm();
    motion.spread_ = spreadOf(squares);
    motion.covariance_ = motion.spread_ * motion.spread_ * solver.solve(Matrix6d::Identity());
  }
  return motion;
}

ExpectedPlace CommonMotion::place(const Eigen::Vector3d& expected,
                                  const StereoCamera& camera) const {
  const Slope J = slopeAt(expected, camera);
  return {expected.head<2>() + J * twist_,
          J * covariance_ * J.transpose() + spread_ * spread_ * Eigen::Matrix2d::Identity()};
}

}  // namespace mvo
