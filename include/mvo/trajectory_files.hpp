// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trajectories in files: the TUM format ("timestamp tx ty tz qx qy qz qw", one pose per line), the
// folder that the bag tool writes, and the truth of a sequence that it is compared with.
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

namespace mvo {

/// A pose at a time.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/// Comments (#) are skipped, quaternions normalized. Throws std::runtime_error naming file and line
/// of what cannot be a pose or of a stamp that does not increase.
std::vector<StampedPose> readTum(const std::filesystem::path& path);

/// Stamps with nine decimals, poses with twelve significant digits. The file appears complete or
/// not at all. Throws std::runtime_error naming the file if it cannot be written.
void writeTum(const std::filesystem::path& path, const std::vector<StampedPose>& poses);

/// One tracklet in one frame, with the label as known at that frame.
struct LabelRow {
  std::int64_t stamp_ns = 0;
  std::int64_t tracklet = 0;
  double u = 0;       ///< in the rectified left image [px]
  double v = 0;       ///< [px]
  int motion_id = 0;  ///< 0 = static world, >= 1 a moving body, -1 = outlier
};

/// One stage in one frame.
struct TimingRow {
  std::int64_t stamp_ns = 0;
  std::string stage;
  double ms = 0;  ///< wall time
};

/// What a covariance is of: the newest step, the motion within the window, or all since the first
/// frame.
enum class MotionSpan { kStep, kWindow, kAll };

/// How a motion moved in the camera from one frame a to a later one b, and how well that is known.
struct MotionCovariance {
  std::int64_t stamp_ns = 0;  ///< of b
  int motion_id = 0;
  MotionSpan span = MotionSpan::kWindow;
  std::int64_t from_ns = 0;  ///< of a
  Eigen::Isometry3d T_cb_ca = Eigen::Isometry3d::Identity();
  /// Of its left perturbation (rho, phi) [m^2, m rad, rad^2].
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Trajectories, labels and times of one run.
struct Estimate {
  std::vector<StampedPose> camera;                  ///< T_world_camera, left optical frame
  std::map<int, std::vector<StampedPose>> motions;  ///< T_world_motion by id >= 1
  bool has_labels = false;                          ///< labels.csv was there, be it empty
  std::vector<LabelRow> labels;
  std::vector<TimingRow> timings;
  std::vector<MotionCovariance> covariances;
};

/// Reads camera.tum, which must be there, and motion_<id>.tum, labels.csv, timing.csv and
/// covariances.csv as far as they exist. Throws std::runtime_error naming the file that cannot be
/// read.
Estimate readEstimate(const std::filesystem::path& folder);

/// What a frame shows of a body.
struct BodyVisibility {
  int body = 0;              ///< >= 1, as in the masks
  int visible_px = 0;        ///< pixels that show the body
  double image_share = 0;    ///< of the image that the body covers
  int silhouette_px = 0;     ///< pixels, also outside the image, it covers if nothing hides it
  double inframe_share = 0;  ///< of the silhouette that is inside the image
  double visible_share = 0;  ///< of the silhouette that is in view and not covered
  std::int64_t stamp_ns = 0;
};

/// A whole body's box in the left image, drawn by hand; it may leave the image.
struct TrueBox {
  std::int64_t stamp_ns = 0;
  double x = 0;             ///< left edge [px]
  double y = 0;             ///< upper edge [px]
  double width = 0;         ///< [px]
  double height = 0;        ///< [px]
  std::string body;         ///< its name; empty for the one body of boxes.csv
  std::string occluded_by;  ///< what hides part of it, a body or anything; empty: nothing
};

/// A body's mean velocity between two frames, in the axes of the camera at the first.
struct TrueVelocity {
  std::string body;  ///< as in the boxes
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  double vx = 0;  ///< to the right [m/s]
  double vz = 0;  ///< forward [m/s]
  double sd = 0;  ///< of vx [m/s]
};

/// The truth of one sequence.
struct Truth {
  std::vector<std::int64_t> stamps_ns;             ///< of every frame, increasing, never empty
  std::vector<StampedPose> camera;                 ///< T_world_camera, left optical frame
  std::map<int, std::vector<StampedPose>> bodies;  ///< T_world_body by id >= 1
  std::vector<BodyVisibility> visibility;          ///< no row = nothing to be seen
  std::vector<TrueBox> boxes;
  std::vector<TrueVelocity> velocities;
  std::optional<StereoCamera> calibration;  ///< where there are boxes, to project into them
  /// The mask of the frame with this index: 8UC1, 0 static, else the body's id; an empty function
  /// if there are no masks, an empty image if this frame has none.
  std::function<cv::Mat(std::size_t)> mask;
};

/// Reads times.txt and truth/ (camera.tum, object_<id>.tum, objects.csv, masks/NNNNNN.png,
/// boxes.csv, body_boxes.csv, velocities.csv, each optional) of a sequence folder. Throws
/// std::runtime_error naming the file that cannot be read; masks are read when they are asked for.
Truth readTruth(const std::filesystem::path& folder);

}  // namespace mvo
