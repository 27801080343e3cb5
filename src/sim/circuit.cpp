// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/circuit.hpp"

#include <algorithm>
#include <cmath>

namespace mvo::sim {
namespace {

constexpr int kSteps = 4096;  // of a lap
constexpr double kStep = 2 * M_PI / kSteps;

}  // namespace

Circuit::Circuit(double radius, const std::vector<Bend>& bends) : radius_(radius), bends_(bends) {
  const auto speed = [this](double angle) { return at(angle).slope.norm(); };
  ways_.push_back(0);
  for (int i = 0; i < kSteps; ++i) {
    // Simpson's rule.
    const double angle = i * kStep;
    ways_.push_back(ways_.back() +
                    kStep / 6 *
                        (speed(angle) + 4 * speed(angle + kStep / 2) + speed(angle + kStep)));
  }
  length_ = ways_.back();
}

Circuit::Point Circuit::at(double angle) const {
  double r = radius_;
  double slope = 0;  // dr / d angle
  for (const Bend& bend : bends_) {
    const double phase = bend.per_turn * angle + bend.phase;
    r += radius_ * bend.amplitude * std::sin(phase);
    slope += radius_ * bend.amplitude * bend.per_turn * std::cos(phase);
  }
  const Eigen::Vector2d outward(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d around(-outward.y(), outward.x());
  return {r * outward, slope * outward + r * around};
}

double Circuit::angleAt(double way) const {
  const auto above = std::upper_bound(ways_.begin(), ways_.end() - 1, way);
  const auto i = static_cast<std::size_t>(above - ways_.begin()) - 1;
  // Cubic interpolation by the slopes at both ends: smooth, as a ride is.
  const double step = ways_[i + 1] - ways_[i];
  const double s = (way - ways_[i]) / step;
  const double low = kStep * static_cast<double>(i);
  const double slope_low = step / at(low).slope.norm();
  const double slope_high = step / at(low + kStep).slope.norm();
  return low + s * (slope_low + s * (3 * kStep - 2 * slope_low - slope_high +
                                     s * (slope_low + slope_high - 2 * kStep)));
}

Eigen::Isometry3d Circuit::pose(double way, double left) const {
  const double laps = std::floor(way / length_);
  const Point point = at(angleAt(way - laps * length_));
  const Eigen::Vector2d forward = point.slope.normalized();
  const Eigen::Vector2d place = point.place + left * Eigen::Vector2d(-forward.y(), forward.x());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << place, 0;
  T.linear() =
      Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ()).matrix();
  return T;
}

}  // namespace mvo::sim
