// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Recordings with truth: what a sequence folder, a published dataset or the simulator gives, frame
// by frame, and the folder that takes it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mvo/stereo_camera.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

/// What holds for all frames of a sequence.
struct SequenceInfo {
  bool rgbd = false;
  StereoCamera camera;
  double rate_hz = 0;
};

/// One frame of a sequence; truth that is not known is left out.
struct SequenceFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< 8UC1 (stereo) or 8UC3 blue, green, red (RGB-D)
  cv::Mat right;  ///< 8UC1 (stereo) or 16UC1 depth [mm], 0 = hole (RGB-D)
  std::optional<Eigen::Isometry3d> T_world_camera;  ///< left optical frame
  std::map<int, Eigen::Isometry3d> T_world_bodies;  ///< by id >= 1
  cv::Mat mask;  ///< 8UC1, of the left image: 0 static, else the body's id; may be empty
  std::vector<BodyVisibility> objects;
};

/// A sequence whose images are read when they are asked for.
struct SequenceSource {
  SequenceInfo info;
  std::size_t frames = 0;
  /// The frame with this index, counted from 0. Throws std::runtime_error naming the file that
  /// cannot be read or has another size than the calibration says.
  std::function<SequenceFrame(std::size_t)> frame;
};

// All of these read calibration, stamps and true poses at once and throw std::runtime_error, one
// sentence naming the file at fault.

/// A folder with calib.json, times.txt, left/ and right/ (or rgb/ and depth/) and truth/, as
/// SequenceWriter writes it.
SequenceSource openSequenceFolder(const std::filesystem::path& folder);

/// A sequence of KITTI odometry: image_0/ and image_1/ (grey), calib.txt, times.txt and, if there,
/// poses.txt in the folder or ../../poses/<folder>.txt. Stamps are moved by 1000 s, since 0 is no
/// time to ROS.
SequenceSource openKitti(const std::filesystem::path& folder);

/// How to read a segment of the Oxford Multimotion Dataset. Empty paths are looked for in the
/// segment's folder and those above it.
struct OxfordOptions {
  std::filesystem::path calibration;         ///< kalibr*.yaml or manufacturer*.yaml
  std::filesystem::path vicon_calibration;   ///< vicon*.yaml with T_apparatus_left
  std::string apparatus = "sensor_payload";  ///< the camera's name in vicon.csv
  bool rectified = false;   ///< the images are rectified, whatever the calibration says
  double vicon_offset = 0;  ///< added to the stamps of vicon.csv [s]
};

/// A segment of the Oxford Multimotion Dataset: stereo.csv (frame number, s, ns) beside
/// NNNNNN_left.png and NNNNNN_right.png, in the folder or its stereo/, and vicon.csv with the poses
/// of camera and bodies, numbered by name from 1. Images are rectified here if the calibration has
/// distortion or a rotation between the cameras. The recordings' clocks are not synchronized:
/// the poses are those nearest in time after the given offset.
SequenceSource openOxford(const std::filesystem::path& folder, const OxfordOptions& options = {});

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
