// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "io/sequences/calib_json.hpp"
#include "io/sequences/image_files.hpp"
#include "io/sequences/numbered_files.hpp"
#include "io/sequences/times_txt.hpp"
#include "io/text_lines.hpp"
#include "io/true_boxes.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

namespace {

namespace fs = std::filesystem;

std::map<int, std::vector<StampedPose>> readBodies(const fs::path& folder) {
  std::map<int, std::vector<StampedPose>> bodies;
  for (const auto& [id, path] : numberedFiles(folder, "object_", ".tum"))
    bodies[id] = readTum(path);
  return bodies;
}

std::vector<BodyVisibility> readVisibility(const fs::path& path) {
  CsvReader csv(path, {"stamp", "id", "visible_image_frac", "visible_frac", "visible_px",
                       "silhouette_px", "inframe_frac"});
  std::vector<BodyVisibility> rows;
  while (csv.next()) {
    BodyVisibility row;
    row.stamp_ns = csv.stamp(0);
    row.body = static_cast<int>(csv.integer(1));
    row.image_share = csv.number(2);
    row.visible_share = csv.number(3);
    row.visible_px = static_cast<int>(csv.number(4));
    row.silhouette_px = static_cast<int>(csv.number(5));
    row.inframe_share = csv.number(6);
    rows.push_back(row);
  }
  return rows;
}

// What is known of bodies that have boxes, and the camera that the boxes are seen by.
void addBoxes(const fs::path& folder, const std::vector<FrameTime>& times, Truth& truth) {
  const fs::path parts = folder / "truth";
  if (fs::exists(parts / "boxes.csv")) truth.boxes = readBoxes(parts / "boxes.csv", times);
  if (fs::exists(parts / "body_boxes.csv")) {
    const std::vector<TrueBox> boxes = readBodyBoxes(parts / "body_boxes.csv", times);
    truth.boxes.insert(truth.boxes.end(), boxes.begin(), boxes.end());
  }
  if (fs::exists(parts / "velocities.csv"))
    truth.velocities = readVelocities(parts / "velocities.csv", times, truth.boxes);
  if (!truth.boxes.empty() && fs::exists(folder / "calib.json"))
    truth.calibration = readCalibration(folder / "calib.json").camera;
}

cv::Mat readMask(const fs::path& folder, std::int64_t number) {
  const fs::path path = folder / (sixDigits(number) + ".png");
  if (!fs::exists(path)) return {};
  cv::Mat mask = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (mask.type() != CV_8UC1) throw std::runtime_error(path.string() + " is not an 8-bit mask");
  return mask;
}

}  // namespace

Truth readTruth(const fs::path& folder) {
  const fs::path truth_folder = folder / "truth";
  if (!fs::is_directory(truth_folder))
    throw std::runtime_error(folder.string() + " is not a sequence with a truth folder");
  const std::vector<FrameTime> times = readTimes(folder / "times.txt");
  Truth truth;
  for (const FrameTime& time : times) truth.stamps_ns.push_back(time.stamp_ns);
  if (fs::exists(truth_folder / "camera.tum")) truth.camera = readTum(truth_folder / "camera.tum");
  truth.bodies = readBodies(truth_folder);
  if (fs::exists(truth_folder / "objects.csv"))
    truth.visibility = readVisibility(truth_folder / "objects.csv");
  addBoxes(folder, times, truth);
  if (fs::is_directory(truth_folder / "masks"))
    truth.mask = [times, masks = truth_folder / "masks"](std::size_t frame) {
      return readMask(masks, times.at(frame).number);
    };
  return truth;
}

}  // namespace mvo
