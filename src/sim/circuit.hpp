// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A closed road with bends, so that a ride on it never ends.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace mvo::sim {

/// The centre line is r(a) = radius (1 + two sines of the angle a) about the world's origin, driven
/// anticlockwise, parametrized by its length.
class Circuit {
 public:
  /// A sine of the circuit's radius.
  struct Bend {
    int per_turn = 2;
    double amplitude = 0;  ///< as a share of the radius
    double phase = 0;      ///< [rad]
  };

  Circuit(double radius, const std::vector<Bend>& bends);

  double length() const { return length_; }  ///< of a lap [m]
  /// The pose at a length of way along the circuit, `left` of its centre line, on the ground: x
  /// forward, z up. Any length is allowed, laps are added up.
  Eigen::Isometry3d pose(double way, double left) const;

 private:
  struct Point {
    Eigen::Vector2d place;
    Eigen::Vector2d slope;  ///< d place / d angle
  };
  Point at(double angle) const;
  double angleAt(double way) const;

  double radius_;
  std::vector<Bend> bends_;
  double length_ = 0;
  std::vector<double> ways_;  ///< to equidistant angles of a lap, both ends included [m]
};

}  // namespace mvo::sim
