// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/consistency.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <optional>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

constexpr double kFreedom = 6;  // degrees of a pose

// Squared error in standard deviations; none if the covariance is singular or a pose unknown.
std::optional<double> squaredError(const FrameClock& clock, const MotionCovariance& row,
                                   const FramePoses& T_ck_l) {
  const auto a = clock.frameOf(row.from_ns);
  const auto b = clock.frameOf(row.stamp_ns);
  if (!a || !b || !T_ck_l[*a] || !T_ck_l[*b]) return std::nullopt;
  const Eigen::Isometry3d T_cb_ca = *T_ck_l[*b] * T_ck_l[*a]->inverse();
  const Vector6d eta = log(row.T_cb_ca * T_cb_ca.inverse());
  const Eigen::LLT<Matrix6d> factor(row.covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return eta.dot(factor.solve(eta));
}

Nees summarized(const std::vector<double>& squares) {
  Nees nees;
  nees.samples = static_cast<int>(squares.size());
  if (squares.empty()) return nees;
  const double far = boost::math::quantile(boost::math::chi_squared(kFreedom), 0.99);
  double sum = 0;
  for (const double square : squares) {
    sum += square;
    if (square > far) ++nees.beyond;
  }
  const double freedom = kFreedom * nees.samples;
  const boost::math::chi_squared of_sum(freedom);
  nees.mean = sum / freedom;
  nees.low = boost::math::quantile(of_sum, 0.025) / freedom;
  nees.high = boost::math::quantile(of_sum, 0.975) / freedom;
  return nees;
}

}  // namespace

Consistency consistencyOf(const FrameClock& clock, const std::vector<MotionCovariance>& rows,
                          const std::vector<int>& ids, const FramePoses& T_ck_l) {
  std::vector<double> steps;
  std::vector<double> windows;
  Consistency result;
  std::optional<std::int64_t> taken_ns;  // the first frame of the last window that counts
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {  // whole windows are the later ones
    if (std::find(ids.begin(), ids.end(), row->motion_id) == ids.end()) continue;
    if (row->span == MotionSpan::kWindow && taken_ns && row->stamp_ns > *taken_ns) continue;
    const auto square = squaredError(clock, *row, T_ck_l);
    if (!square) continue;
    if (row->span == MotionSpan::kStep) steps.push_back(*square);
    if (row->span == MotionSpan::kAll)
      result.all.push_back({*clock.frameOf(row->stamp_ns), *square / kFreedom});
    if (row->span == MotionSpan::kWindow) {
      windows.push_back(*square);
      taken_ns = row->from_ns;
    }
  }
  std::reverse(result.all.begin(), result.all.end());
  result.step = summarized(steps);
  result.window = summarized(windows);
  return result;
}

}  // namespace mvo
