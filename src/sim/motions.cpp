// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motions.hpp"

#include <cmath>

namespace mvo::sim {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

Eigen::AngleAxisd aboutX(double angle) { return {angle, Eigen::Vector3d::UnitX()}; }
Eigen::AngleAxisd aboutY(double angle) { return {angle, Eigen::Vector3d::UnitY()}; }
Eigen::AngleAxisd aboutZ(double angle) { return {angle, Eigen::Vector3d::UnitZ()}; }

Eigen::Isometry3d pose(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  T.translation() = t;
  return T;
}

// One coordinate of a hand: three slow waves and a tremor, of the given total amplitude.
std::array<Wave, 4> sway(double amplitude, double tremor, Random& random) {
  constexpr std::array<double, 4> kShare = {0.45, 0.40, 0.25, 1.0};
  constexpr std::array<double, 5> kBands = {0.06, 0.12, 0.20, 0.30, 1.3};  // [Hz]
  std::array<Wave, 4> waves;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    waves[i].amplitude = kShare[i] * (i < 3 ? amplitude : tremor);
    waves[i].frequency = i < 3 ? random.uniform(kBands[i], kBands[i + 1])
                               : random.uniform(kBands[4], 1.6 * kBands[4]);
    waves[i].phase = random.uniform(0, 2 * M_PI);
  }
  return waves;
}

}  // namespace

Eigen::Matrix3d forwardLooking() {
  Eigen::Matrix3d R_world_camera;
  R_world_camera << 0, 0, 1,  //
      -1, 0, 0,               //
      0, -1, 0;
  return R_world_camera;
}

double Wave::at(double t) const {
  return start + rate * t + amplitude * std::sin(2 * M_PI * frequency * t + phase);
}

Motion handheld(const Handheld& mean, Random random) {
  constexpr double kTremor = 0.0012;      // [m]
  constexpr double kTremorAngle = 0.001;  // [rad]
  std::array<std::array<Wave, 4>, 6> waves;
  for (int i = 0; i < 3; ++i) {
    waves[i] = sway(mean.sway[i], kTremor, random);
    waves[3 + i] = sway(mean.turn[i], kTremorAngle, random);
  }
  return [mean, waves](double t) {
    std::array<double, 6> offset{};
    for (int i = 0; i < 6; ++i) {
      for (const Wave& wave : waves[i]) offset[i] += wave.at(t);
    }
    const Eigen::Matrix3d R =
        (aboutZ(offset[5]) * aboutY(mean.pitch + offset[4]) * aboutX(offset[3])).matrix();
    return pose(R * forwardLooking(),
                mean.position + Eigen::Vector3d(offset[0], offset[1], offset[2]));
  };
}

Motion pendulum(const Pendulum& pendulum) {
  return [pendulum](double t) {
    const double omega = std::sqrt(kGravity / pendulum.length);
    const double about_x = pendulum.tilt.x() * std::sin(omega * t + pendulum.phase.x());
    const double about_y = pendulum.tilt.y() * std::sin(omega * t + pendulum.phase.y());
    const Eigen::Matrix3d R =
        (aboutX(about_x) * aboutY(about_y) * aboutZ(pendulum.yaw.at(t))).matrix();
    return pose(R, pendulum.pivot - pendulum.length * R.col(2));
  };
}

Motion wandering(const std::array<Wave, 3>& position, const Wave& yaw) {
  return [position, yaw](double t) {
    return pose(aboutZ(yaw.at(t)).matrix(),
                {position[0].at(t), position[1].at(t), position[2].at(t)});
  };
}

double stopAndGo(double t, double go, double rest, double ramp) {
  const double period = go + rest;
  const double cycles = std::floor(t / period);
  const double s = t - cycles * period;  // since the start of this ride
  const double full = go - ramp;         // of one ride
  double distance = full;
  if (s < ramp) {
    distance = s * s / (2 * ramp);
  } else if (s < go - ramp) {
    distance = s - ramp / 2;
  } else if (s < go) {
    distance = full - (go - s) * (go - s) / (2 * ramp);
  }
  return cycles * full + distance;
}

double driven(const Drive& drive, double t) {
  constexpr double kRamp = 0.6;  // [s]
  return stopAndGo(t - drive.delay, drive.go, drive.rest, kRamp);
}

Motion driving(const Drive& drive) {
  return [drive](double t) {
    const double seconds = driven(drive, t);
    const double angle = drive.start + drive.speed * seconds / drive.radii.mean();
    const double forward = drive.speed < 0 ? -1 : 1;
    const double heading = std::atan2(forward * drive.radii.y() * std::cos(angle),
                                      -forward * drive.radii.x() * std::sin(angle));
    const Eigen::Vector3d offset(drive.radii.x() * std::cos(angle),
                                 drive.radii.y() * std::sin(angle), 0);
    return pose(aboutZ(heading).matrix(), drive.center + offset);
  };
}

}  // namespace mvo::sim
