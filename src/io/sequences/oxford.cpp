// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The layout is what the dataset's own tools (github.com/robotic-esp/dataset_tools) read:
// stereo.csv with frame number, seconds and nanoseconds, NNNNNN_left.png and NNNNNN_right.png
// beside it; vicon.csv with seconds, nanoseconds, object, quaternion, translation and from the
// eleventh column on the row-major 4x4 T_world_object; Kalibr's camera chain; T_apparatus_left.
// Assumed beyond that: the left camera's frame is optical, and rotations or distortion in the
// calibration mean raw images.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "io/sequences/frame_rate.hpp"
#include "io/sequences/image_files.hpp"
#include "io/sequences/kalibr.hpp"
#include "io/sequences/times_txt.hpp"
#include "io/text_lines.hpp"
#include "mvo/se3.hpp"
#include "mvo/sequence.hpp"

namespace mvo {

namespace {

namespace fs = std::filesystem;

constexpr double kSmallRotation = 1e-6;  // [rad]
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr int kLevels = 4;            // folders a calibration is looked for in
constexpr std::size_t kColumns = 26;  // of vicon.csv
constexpr std::size_t kMatrix = 10;   // its first column of the 4x4 pose

// The first file <prefix>*.yaml in the folder or one of three above it.
fs::path findYaml(fs::path folder, const std::vector<std::string>& prefixes) {
  folder = fs::absolute(folder / ".").parent_path();
  for (int level = 0; level < kLevels && !folder.empty(); ++level) {
    for (const std::string& prefix : prefixes) {
      std::vector<fs::path> found;
      for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.rfind(prefix, 0) == 0 && entry.path().extension() == ".yaml")
          found.push_back(entry.path());
      }
      if (!found.empty()) return *std::min_element(found.begin(), found.end());
    }
    folder = folder.parent_path();
  }
  return {};
}

std::int64_t stampFrom(const LineReader& lines, std::size_t first) {
  return lines.integer(first) * kSecond + lines.integer(first + 1);
}

std::vector<FrameTime> readStereoCsv(const fs::path& path) {
  LineReader lines(path, ',');
  lines.next();  // the header
  std::vector<FrameTime> times;
  while (lines.next()) {
    const FrameTime time{lines.integer(0), stampFrom(lines, 1)};
    if (!times.empty() && time.stamp_ns <= times.back().stamp_ns)
      lines.fail("the stamp does not increase");
    times.push_back(time);
  }
  if (times.empty()) throw std::runtime_error(path.string() + " has no frames");
  return times;
}

// Poses by object and stamp.
using ViconPoses = std::map<std::string, std::map<std::int64_t, Eigen::Isometry3d>>;

ViconPoses readViconCsv(const fs::path& path, std::int64_t offset_ns) {
  LineReader lines(path, ',');
  lines.next();  // the header
  ViconPoses poses;
  while (lines.next()) {
    if (lines.size() < kColumns)
      lines.fail("a pose has 26 columns, not " + std::to_string(lines.size()));
    Eigen::Matrix<double, 3, 4> M;
    for (std::size_t i = 0; i < 12; ++i)
      M(static_cast<int>(i) / 4, static_cast<int>(i) % 4) = lines.number(kMatrix + i);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = nearestRotation(M.leftCols<3>());
    T.translation() = M.col(3);
    poses[lines.text(2)][stampFrom(lines, 0) + offset_ns] = T;
  }
  return poses;
}

// The pose nearest in time, at most half a frame away.
std::optional<Eigen::Isometry3d> nearest(const std::map<std::int64_t, Eigen::Isometry3d>& poses,
                                         std::int64_t stamp_ns, std::int64_t tolerance_ns) {
  auto candidate = poses.lower_bound(stamp_ns);
  if (candidate == poses.end() ||
      (candidate != poses.begin() &&
       stamp_ns - std::prev(candidate)->first < candidate->first - stamp_ns)) {
    if (candidate == poses.begin()) return {};
    --candidate;
  }
  if (std::abs(candidate->first - stamp_ns) > tolerance_ns) return {};
  return candidate->second;
}

struct Pair {
  KalibrCamera left;
  KalibrCamera right;
};

// By the names of their topics where these say so, else the first two.
Pair stereoPair(const std::vector<KalibrCamera>& chain, const fs::path& path) {
  const auto named = [&](const std::string& side) {
    return std::find_if(chain.begin(), chain.end(), [&](const KalibrCamera& camera) {
      return camera.topic.find(side) != std::string::npos;
    });
  };
  const auto left = named("left");
  const auto right = named("right");
  if (left != chain.end() && right != chain.end()) return {*left, *right};
  if (chain.size() < 2) throw std::runtime_error(path.string() + " has no second camera");
  return {chain[0], chain[1]};
}

/// What makes a rectified pair of a recorded one.
struct Rectifier {
  StereoCamera camera;
  Eigen::Isometry3d T_left_rectified = Eigen::Isometry3d::Identity();
  bool remap = false;
  cv::Mat left_x, left_y, right_x, right_y;

  cv::Mat operator()(const cv::Mat& image, bool is_left) const {
    if (!remap) return image;
    cv::Mat result;
    cv::remap(image, result, is_left ? left_x : right_x, is_left ? left_y : right_y,
              cv::INTER_LINEAR);
    return result;
  }
};

cv::Mat cameraMatrix(const KalibrCamera& camera) {
  const std::vector<double>& k = camera.intrinsics;
  return (cv::Mat_<double>(3, 3) << k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1);
}

bool isZero(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
}

Rectifier makeRectifier(const Pair& pair, bool rectified) {
  Rectifier rectifier;
  const Eigen::Isometry3d T_right_left = pair.right.T_cn_c0 * pair.left.T_cn_c0.inverse();
  StereoCamera& camera = rectifier.camera;
  camera.width = pair.left.width;
  camera.height = pair.left.height;
  camera.fu = pair.left.intrinsics[0];
  camera.fv = pair.left.intrinsics[1];
  camera.cu = pair.left.intrinsics[2];
  camera.cv = pair.left.intrinsics[3];
  camera.baseline = T_right_left.translation().norm();
  rectifier.remap = !rectified && !(isZero(pair.left.distortion) && isZero(pair.right.distortion) &&
                                    angle(T_right_left.linear()) < kSmallRotation);
  if (!rectifier.remap) return rectifier;
  cv::Mat R, t, Rl, Rr, Pl, Pr, Q;
  const Eigen::Matrix3d rotation = T_right_left.linear();
  const Eigen::Vector3d translation = T_right_left.translation();
  cv::eigen2cv(rotation, R);
  cv::eigen2cv(translation, t);
  const cv::Size size(camera.width, camera.height);
  const cv::Mat Kl = cameraMatrix(pair.left);
  const cv::Mat Kr = cameraMatrix(pair.right);
  cv::stereoRectify(Kl, pair.left.distortion, Kr, pair.right.distortion, size, R, t, Rl, Rr, Pl, Pr,
                    Q, cv::CALIB_ZERO_DISPARITY, 0);
  cv::initUndistortRectifyMap(Kl, pair.left.distortion, Rl, Pl, size, CV_16SC2, rectifier.left_x,
                              rectifier.left_y);
  cv::initUndistortRectifyMap(Kr, pair.right.distortion, Rr, Pr, size, CV_16SC2, rectifier.right_x,
                              rectifier.right_y);
  camera.fu = Pl.at<double>(0, 0);
  camera.fv = Pl.at<double>(1, 1);
  camera.cu = Pl.at<double>(0, 2);
  camera.cv = Pl.at<double>(1, 2);
  camera.baseline = -Pr.at<double>(0, 3) / Pr.at<double>(0, 0);
  Eigen::Matrix3d C;
  cv::cv2eigen(Rl, C);
  rectifier.T_left_rectified.linear() = C.transpose();
  return rectifier;
}

/// True poses of the segment.
struct ViconTruth {
  std::map<std::int64_t, Eigen::Isometry3d> camera;                 ///< T_world_camera, rectified
  std::map<int, std::map<std::int64_t, Eigen::Isometry3d>> bodies;  ///< T_world_body
};

ViconTruth readVicon(const fs::path& folder, const OxfordOptions& options,
                     const Rectifier& rectifier) {
  ViconTruth truth;
  const fs::path path = folder / "vicon.csv";
  if (!fs::exists(path)) return truth;
  ViconPoses poses =
      readViconCsv(path, std::llround(options.vicon_offset * static_cast<double>(kSecond)));
  const auto apparatus = poses.find(options.apparatus);
  if (apparatus == poses.end())
    throw std::runtime_error(path.string() + " has no object '" + options.apparatus + "'");
  const fs::path calibration =
      options.vicon_calibration.empty() ? findYaml(folder, {"vicon"}) : options.vicon_calibration;
  if (calibration.empty())
    throw std::runtime_error("no vicon*.yaml with T_apparatus_left at or above " + folder.string());
  const Eigen::Isometry3d T_apparatus_camera =
      readKalibrTransform(calibration, "T_apparatus_left") * rectifier.T_left_rectified;
  for (const auto& [stamp_ns, T_world_apparatus] : apparatus->second)
    truth.camera[stamp_ns] = T_world_apparatus * T_apparatus_camera;
  poses.erase(apparatus);
  int id = 0;
  for (auto& [name, trajectory] : poses) truth.bodies[++id] = std::move(trajectory);
  return truth;
}

}  // namespace

SequenceSource openOxford(const fs::path& folder, const OxfordOptions& options) {
  const fs::path images = fs::exists(folder / "stereo.csv") ? folder : folder / "stereo";
  const std::vector<FrameTime> times = readStereoCsv(images / "stereo.csv");
  const fs::path calibration = options.calibration.empty()
                                   ? findYaml(folder, {"kalibr", "manufacturer"})
                                   : options.calibration;
  if (calibration.empty())
    throw std::runtime_error("no kalibr*.yaml or manufacturer*.yaml at or above " +
                             folder.string());
  const Pair pair = stereoPair(readKalibrChain(calibration), calibration);
  const auto rectifier = std::make_shared<const Rectifier>(makeRectifier(pair, options.rectified));
  const auto truth = std::make_shared<const ViconTruth>(readVicon(folder, options, *rectifier));

  SequenceSource source;
  source.info.camera = rectifier->camera;
  try {
    source.info.camera.validate();
  } catch (const std::exception& error) {
    throw std::runtime_error(calibration.string() + ": " + error.what());
  }
  std::vector<std::int64_t> stamps;
  stamps.reserve(times.size());
  for (const FrameTime& time : times) stamps.push_back(time.stamp_ns);
  source.info.rate_hz = frameRate(stamps);
  source.frames = times.size();
  const std::int64_t tolerance_ns =
      source.info.rate_hz > 0 ? std::llround(0.5e9 / source.info.rate_hz) : kSecond;
  source.frame = [images, times, rectifier, truth, tolerance_ns](std::size_t k) {
    const std::string stem = sixDigits(times.at(k).number);
    SequenceFrame frame;
    frame.stamp_ns = times[k].stamp_ns;
    const auto read = [&](const std::string& side) {
      return (*rectifier)(
          readImage(images, stem + "_" + side, cv::IMREAD_GRAYSCALE, rectifier->camera),
          side == "left");
    };
    frame.left = read("left");
    frame.right = read("right");
    frame.T_world_camera = nearest(truth->camera, frame.stamp_ns, tolerance_ns);
    for (const auto& [id, poses] : truth->bodies)
      if (const auto pose = nearest(poses, frame.stamp_ns, tolerance_ns))
        frame.T_world_bodies[id] = *pose;
    return frame;
  };
  return source;
}

}  // namespace mvo
