// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "io/sequences/frame_rate.hpp"
#include "io/sequences/image_files.hpp"
#include "io/text_lines.hpp"
#include "mvo/se3.hpp"
#include "mvo/sequence.hpp"

namespace mvo {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kEpoch = 1000'000'000'000;  // [ns]
constexpr double kMaxRotationError = 0.01;         // of the printed matrices

using Projection = Eigen::Matrix<double, 3, 4>;

Projection matrix(const LineReader& lines, std::size_t first) {
  Projection M;
  for (std::size_t i = 0; i < 12; ++i)
    M(static_cast<int>(i) / 4, static_cast<int>(i) % 4) = lines.number(first + i);
  return M;
}

StereoCamera readCalibration(const fs::path& path) {
  LineReader lines(path);
  Projection left = Projection::Zero();
  Projection right = Projection::Zero();
  while (lines.next()) {
    if (lines.text(0) == "P0:") left = matrix(lines, 1);
    if (lines.text(0) == "P1:") right = matrix(lines, 1);
  }
  if (left(0, 0) <= 0 || right(0, 0) <= 0)
    throw std::runtime_error(path.string() + " has no projections P0 and P1");
  StereoCamera camera;
  camera.fu = left(0, 0);
  camera.fv = left(1, 1);
  camera.cu = left(0, 2);
  camera.cv = left(1, 2);
  camera.baseline = (left(0, 3) - right(0, 3)) / left(0, 0);
  return camera;
}

std::vector<std::int64_t> readStamps(const fs::path& path) {
  LineReader lines(path);
  std::vector<std::int64_t> stamps;
  while (lines.next()) {
    stamps.push_back(kEpoch + lines.stamp(0));
    if (stamps.size() > 1 && stamps.back() <= stamps[stamps.size() - 2])
      lines.fail("the stamp does not increase");
  }
  if (stamps.empty()) throw std::runtime_error(path.string() + " has no frames");
  return stamps;
}

// T_world_camera of every frame; empty if there is no such file.
std::vector<Eigen::Isometry3d> readPoses(const fs::path& folder, std::size_t frames) {
  fs::path path = folder / "poses.txt";
  if (!fs::exists(path)) {
    const fs::path whole = fs::absolute(folder / ".").parent_path();
    path = whole.parent_path().parent_path() / "poses" / (whole.filename().string() + ".txt");
  }
  if (!fs::exists(path)) return {};
  LineReader lines(path);
  std::vector<Eigen::Isometry3d> poses;
  while (lines.next()) {
    const Projection M = matrix(lines, 0);
    const Eigen::Matrix3d C = M.leftCols<3>();
    const Eigen::Matrix3d R = nearestRotation(C);
    if ((R - C).norm() > kMaxRotationError) lines.fail("the pose has no rotation");
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = R;
    T.translation() = M.col(3);
    poses.push_back(T);
  }
  if (poses.size() != frames)
    throw std::runtime_error(path.string() + " has " + std::to_string(poses.size()) +
                             " poses for " + std::to_string(frames) + " frames");
  return poses;
}

}  // namespace

SequenceSource openKitti(const fs::path& folder) {
  SequenceSource source;
  source.info.camera = readCalibration(folder / "calib.txt");
  const std::vector<std::int64_t> stamps = readStamps(folder / "times.txt");
  source.info.rate_hz = frameRate(stamps);
  source.frames = stamps.size();
  const cv::Size size = imageSize(folder / "image_0", sixDigits(0));
  source.info.camera.width = size.width;
  source.info.camera.height = size.height;
  try {
    source.info.camera.validate();
  } catch (const std::exception& error) {
    throw std::runtime_error((folder / "calib.txt").string() + ": " + error.what());
  }
  const std::vector<Eigen::Isometry3d> poses = readPoses(folder, stamps.size());
  source.frame = [folder, stamps, poses, camera = source.info.camera](std::size_t k) {
    const std::string stem = sixDigits(static_cast<std::int64_t>(k));
    SequenceFrame frame;
    frame.stamp_ns = stamps.at(k);
    frame.left = readImage(folder / "image_0", stem, cv::IMREAD_GRAYSCALE, camera);
    frame.right = readImage(folder / "image_1", stem, cv::IMREAD_GRAYSCALE, camera);
    if (!poses.empty()) frame.T_world_camera = poses[k];
    return frame;
  };
  return source;
}

}  // namespace mvo
