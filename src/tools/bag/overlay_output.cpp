// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/overlay_output.hpp"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace mvo_tools {

namespace fs = std::filesystem;

namespace {

constexpr double kUsualRate = 15;  // [Hz]
constexpr char kFirstFrame[] = "000000.png";

fs::path insideOf(const fs::path& folder, const fs::path& path) {
  const fs::path relative = fs::absolute(path).lexically_normal().lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." || relative == "." ? fs::path() : relative;
}

int fourcc(const fs::path& path) {
  const std::string extension = path.extension();
  if (extension == ".avi") return cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  return cv::VideoWriter::fourcc('m', 'p', '4', 'v');
}

}  // namespace

OverlayOutput::OverlayOutput(const OverlayTargets& targets, const StagedOutput& run,
                             const cv::Size& image, double frames_per_second)
    : overlay_(image) {
  if (!targets.video.empty()) {
    const std::string extension = targets.video.extension();
    if (extension != ".mp4" && extension != ".avi" && extension != ".mkv")
      throw std::runtime_error("overlay video '" + targets.video.string() +
                               "' must be named .mp4, .mkv or .avi");
    video_path_ =
        stage(staged_video_, targets.video, StagedOutput::Kind::kFile, targets.force, run);
    const double rate =
        frames_per_second > 0 ? std::clamp(frames_per_second, 1.0, 120.0) : kUsualRate;
    if (!video_.open(video_path_.string(), fourcc(targets.video), rate, overlay_.size()))
      throw std::runtime_error("overlay video '" + targets.video.string() +
                               "' cannot be written: no encoder or no such folder");
  }
  if (!targets.frames.empty()) {
    frames_path_ =
        stage(staged_frames_, targets.frames, StagedOutput::Kind::kFolder, targets.force, run);
    fs::create_directories(frames_path_);
  }
}

fs::path OverlayOutput::stage(std::optional<StagedOutput>& staged, const fs::path& target,
                              StagedOutput::Kind kind, bool force, const StagedOutput& run) {
  const fs::path inside = insideOf(run.target(), target);
  if (inside.empty()) return staged.emplace(target, kind, force, kFirstFrame).path();
  fs::path path = run.path() / inside;
  fs::create_directories(path.parent_path());
  return path;
}

void OverlayOutput::add(const cv::Mat& left, const mvo::MultimotionEstimate& estimate) {
  if (video_path_.empty() && frames_path_.empty()) return;
  const cv::Mat picture = overlay_.draw(left, estimate);
  if (video_.isOpened()) video_.write(picture);
  if (frames_path_.empty()) return;
  char name[32];
  std::snprintf(name, sizeof(name), "%06lld.png", static_cast<long long>(estimate.frame));
  if (!cv::imwrite((frames_path_ / name).string(), picture))
    throw std::runtime_error("overlay picture '" + (frames_path_ / name).string() +
                             "' cannot be written");
}

void OverlayOutput::commit() {
  video_.release();
  if (!video_path_.empty() && (!fs::exists(video_path_) || fs::file_size(video_path_) == 0))
    throw std::runtime_error("overlay video '" + video_path_.string() + "' was not written");
  if (staged_video_) staged_video_->commit();
  if (staged_frames_) staged_frames_->commit();
}

}  // namespace mvo_tools
