// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What /diagnostics says.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "ros/live/odometry_session.hpp"

namespace mvo_ros {

/// Collects what happens and sums it up. Safe from any thread.
class Health {
 public:
  /// A step that was published, `latency` after its stamp and `waiting` after its arrival [s].
  void step(const Step& step, double latency, double since_arrival);
  /// What is in force: features of those wanted, and a step's time limit [ms], 0 = none.
  void load(int features, int wanted, double limit_ms);
  /// A set that could not be used.
  void refused(const std::string& problem);
  /// A set that is kept until what it needs is there; the next step ends it.
  void blocked(const std::string& problem);
  void paused(bool is);
  /// Frames dropped so far because newer ones came.
  void dropped(std::uint64_t count);
  /// No set for so long [s], and why; empty: sets arrive.
  void silent(const std::string& report);

  /// Level, one sentence and all figures since the last call.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  // What was left out lately to keep up.
  std::string sacrifices() const;
  void reportCameraErrors(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const;  // with the lock

  struct Figures {
    int steps = 0;
    int lost = 0;
    int refused = 0;
    int overrun = 0;      // steps longer than the frame period
    int cut_short = 0;    // steps that left out something
    std::string slowest;  // stage of the longest step
    double worst_ms = 0;
  };

  std::mutex mutex_;
  Figures recent_;
  ros::WallTime since_ = ros::WallTime::now();
  std::uint64_t frames_ = 0;
  std::uint64_t frames_refused_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t dropped_reported_ = 0;
  double latency_ = 0;
  double since_arrival_ = 0;
  double step_ms_ = 0;
  int features_ = 0;
  int features_wanted_ = 0;
  double limit_ms_ = 0;
  std::string cut_short_;  // what the last such step left out
  std::size_t tracklets_ = 0;
  std::size_t motions_ = 0;
  unsigned resets_ = 0;
  int world_changes_ = 0;
  int world_changes_reported_ = 0;
  unsigned resets_reported_ = 0;
  bool lost_ = false;
  bool paused_ = false;
  std::vector<std::pair<std::string, double>> stages_ms_;
  std::optional<mvo::CameraErrorReport> camera_errors_;
  std::string silence_;
  std::string blockage_;
  std::string notice_;
  std::string last_error_;
};

}  // namespace mvo_ros
