// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A sequence as a folder: calib.json, times.txt, numbered PNG images and what is known of the truth
// (truth/camera.tum, object_<id>.tum, masks/NNNNNN.png, objects.csv), as readTruth reads it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mvo/io/sequence.hpp"
#include "mvo/io/tum.hpp"

namespace mvo {

/// Images are written as they come, all tables by finish(): before, the folder is not a sequence.
class SequenceWriter {
 public:
  /// Creates the folder's parts. Throws std::runtime_error naming what cannot be written, as do the
  /// other functions.
  SequenceWriter(const std::filesystem::path& folder, const SequenceInfo& info);

  void add(const SequenceFrame& frame);
  void finish();

 private:
  void writeImage(const std::string& part, const cv::Mat& image) const;
  std::string calibration() const;

  std::filesystem::path folder_;
  SequenceInfo info_;
  int frames_ = 0;
  std::string times_;
  std::string objects_;
  std::vector<StampedPose> camera_;
  std::map<int, std::vector<StampedPose>> bodies_;
};

}  // namespace mvo
