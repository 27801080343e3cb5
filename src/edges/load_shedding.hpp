// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Soft real time: how much work a frame may be, from how long frames take and how often they come.
#pragma once

#include <deque>
#include <optional>

namespace mvo_ros {

/// The time between frames, from their stamps: what the camera sends, also if some get lost.
class FramePeriod {
 public:
  /// A set's stamp, and the ROS clock and the wall clock at its arrival [s]. A recording played
  /// faster has a faster clock, and its frames less time.
  void add(double stamp, double clock, double wall);
  /// Median of the last ones on the wall clock; none before there are a few.
  std::optional<double> seconds() const;

 private:
  struct Arrival {
    double stamp;
    double clock;
    double wall;
  };
  std::deque<Arrival> arrivals_;
};

/// Sheds features when most of the last steps near the frame period, more of them the longer the
/// steps are; takes them back slowly when nearly all have had room for long. As a last resort, with
/// the fewest features, a step's time is limited too. One slow step changes nothing, and what is
/// taken back cannot by itself cause the next shedding: no oscillation.
class LoadShedding {
 public:
  static constexpr int kFewest = 150;  ///< features that are never shed

  /// After a step that took so long. `most`: features wanted.
  void step(double step_ms, double period_ms, int most);
  /// All features again.
  void reset() { *this = LoadShedding(); }

  /// Features in force, if so many are wanted.
  int features(int most) const;
  /// Of a step's time budget [ms], of which `outside_ms` go elsewhere; 0 = no limit.
  double budget(double period_ms, double outside_ms) const;

 private:
  std::optional<int> features_;  // none: as many as wanted
  bool limits_time_ = false;
  std::deque<double> loads_;  // recent steps in frame periods, newest last
};

}  // namespace mvo_ros
