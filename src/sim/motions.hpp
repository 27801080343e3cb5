// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The motions that scenes are made of: a hand, pendulums, turning and driving bodies.
#pragma once

#include <array>

#include "mvo/sim.hpp"
#include "sim/random.hpp"

namespace mvo::sim {

/// An angle or coordinate over time: start + rate t + a sine.
struct Wave {
  double start = 0;
  double rate = 0;       ///< [1/s]
  double amplitude = 0;  ///< of the sine
  double frequency = 0;  ///< of the sine [Hz]
  double phase = 0;      ///< of the sine [rad]

  double at(double t) const;
};

/// The optical frame (z forward, x right, y down) of a camera that looks along x, z being up.
Eigen::Matrix3d forwardLooking();

/// A camera in a walking person's hands.
struct Handheld {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mean, in the world [m]
  Eigen::Vector3d sway = Eigen::Vector3d::Zero();      ///< amplitude along world x, y, z [m]
  double pitch = 0;                                    ///< mean, positive looks down [rad]
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();      ///< amplitude of roll, pitch and yaw [rad]
};

/// Looks along world x on average; slow sway and a faint tremor.
Motion handheld(const Handheld& mean, Random random);

/// A rigid pendulum: string and body swing together about the pivot and turn about the string.
struct Pendulum {
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< in the world [m]
  double length = 1;                                ///< pivot to body centre [m]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();   ///< amplitude about world x and y [rad]
  Eigen::Vector2d phase = Eigen::Vector2d::Zero();  ///< [rad]
  Wave yaw;                                         ///< about the string [rad]
};

/// Swings with the period gravity gives it.
Motion pendulum(const Pendulum& pendulum);

/// Constant position and tilt, yaw about the world's vertical; position moves by waves.
Motion wandering(const std::array<Wave, 3>& position, const Wave& yaw);

/// Drives around an ellipse on the floor, goes and rests in turns.
struct Drive {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the ellipse [m]
  Eigen::Vector2d radii = Eigen::Vector2d::Ones();   ///< along world x and y [m]
  double speed = 0;  ///< while it goes, on average; negative drives clockwise [m/s]
  double start = 0;  ///< angle on the ellipse at time 0 [rad]
  double go = 1;     ///< length of a ride [s]
  double rest = 0;   ///< length of a stop [s]
  double delay = 0;  ///< of the first start, may be negative [s]
};

/// Seconds at full speed that a drive has taken by a time [s].
double driven(const Drive& drive, double t);

/// Body frame: x forward, z up.
Motion driving(const Drive& drive);

/// Seconds of travel at full speed after time t, of a vehicle that goes and rests in turns and
/// needs `ramp` seconds to reach its speed and to stop.
double stopAndGo(double t, double go, double rest, double ramp);

}  // namespace mvo::sim
