// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The folder that the bag tool writes: what was estimated of a sequence.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "mvo/io/labels_csv.hpp"
#include "mvo/io/timing_csv.hpp"
#include "mvo/io/tum.hpp"

namespace mvo {

/// Trajectories, labels and times of one run.
struct Estimate {
  std::vector<StampedPose> camera;                  ///< T_world_camera, left optical frame
  std::map<int, std::vector<StampedPose>> motions;  ///< T_world_motion by id >= 1
  bool has_labels = false;                          ///< labels.csv was there, be it empty
  std::vector<LabelRow> labels;
  std::vector<TimingRow> timings;
};

/// Reads camera.tum, which must be there, and motion_<id>.tum, labels.csv and timing.csv as far as
/// they exist. Throws std::runtime_error naming the file that cannot be read.
Estimate readEstimate(const std::filesystem::path& folder);

}  // namespace mvo
