// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a run leaves behind: camera.tum, motion_<id>.tum, labels.csv, timing.csv, covariances.csv
// and the counts for summary.json.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/timing_csv.hpp"
#include "mvo/odometry.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo_tools {

/// Collects the estimates of a run in a folder.
class RunWriter {
 public:
  enum class Poses { kCausal, kSmoothed };

  RunWriter(std::filesystem::path folder, Poses poses);

  /// Adds a frame. `edge_timings_ms` are the stages outside the library (decode, rectify),
  /// `total_ms` is the step as a whole.
  void add(const mvo::MultimotionEstimate& estimate,
           const std::vector<std::pair<std::string, double>>& edge_timings_ms, double total_ms);

  /// Writes what is still in memory. Throws std::runtime_error naming the file.
  void finish();

  std::int64_t frames() const { return frames_; }
  /// Frames with a pose of the camera.
  std::int64_t estimated() const { return estimated_; }
  std::int64_t estimatedAfterFirst() const { return estimated_after_first_; }
  /// The sentence of the last frame without an estimate.
  const std::string& lastProblem() const { return last_problem_; }
  /// Counts and step times.
  nlohmann::ordered_json summary() const;

 private:
  using Key = std::pair<mvo::LabelId, mvo::FrameId>;

  void addPoses(const mvo::MultimotionEstimate& estimate);
  void addCovariances(const mvo::MultimotionEstimate& estimate);

  std::filesystem::path folder_;
  Poses poses_;
  mvo::AtomicFile labels_;
  std::vector<mvo::TimingRow> timings_;
  std::vector<mvo::MotionCovariance> covariances_;
  std::optional<std::pair<mvo::FrameId, Eigen::Isometry3d>> first_pose_;  // T_world_camera
  std::vector<double> totals_ms_;
  std::map<mvo::FrameId, std::int64_t> stamps_ns_;
  std::map<Key, Eigen::Isometry3d> T_world_motion_;
  std::map<mvo::LabelId, std::int64_t> frames_of_;
  std::map<std::string, std::int64_t> problems_;
  std::string last_problem_;
  std::map<std::string, std::vector<mvo::FrameId>> notices_;  // and the frames they were said in
  int world_changes_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t estimated_ = 0;
  std::int64_t estimated_after_first_ = 0;
  std::int64_t unestimated_labels_ = 0;
};

}  // namespace mvo_tools
