// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The overlay's pictures as a video, as PNG files, or both.
#pragma once

#include <filesystem>
#include <opencv2/videoio.hpp>
#include <optional>
#include <string>

#include "edges/overlay.hpp"
#include "tools/staged_output.hpp"

namespace mvo_tools {

/// Where overlays go; empty names are not wanted.
struct OverlayTargets {
  std::filesystem::path video;
  std::filesystem::path frames;
  bool force = false;
};

/// Writes the pictures under temporary names until commit(). Targets inside the run's own folder go
/// into its staged folder and appear with it.
class OverlayOutput {
 public:
  /// Throws std::runtime_error naming the file, also if there is no encoder for its extension.
  OverlayOutput(const OverlayTargets& targets, const StagedOutput& run, const cv::Size& image,
                double frames_per_second);

  void add(const cv::Mat& left, const mvo::MultimotionEstimate& estimate);
  /// Throws std::runtime_error.
  void commit();

 private:
  std::filesystem::path stage(std::optional<StagedOutput>& staged,
                              const std::filesystem::path& target, StagedOutput::Kind kind,
                              bool force, const StagedOutput& run);

  mvo_ros::Overlay overlay_;
  std::optional<StagedOutput> staged_video_;
  std::optional<StagedOutput> staged_frames_;
  std::filesystem::path video_path_;
  std::filesystem::path frames_path_;
  cv::VideoWriter video_;
};

}  // namespace mvo_tools
