// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "io/frame_clock.hpp"
#include "io/sequences/calib_json.hpp"
#include "io/sequences/frame_rate.hpp"
#include "io/sequences/image_files.hpp"
#include "io/sequences/times_txt.hpp"
#include "mvo/sequence.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

namespace {

namespace fs = std::filesystem;

// The truth, frame by frame.
struct TruthTable {
  FramePoses camera;
  std::map<int, FramePoses> bodies;
  std::vector<std::vector<BodyVisibility>> objects;
  std::function<cv::Mat(std::size_t)> mask;
};

TruthTable readTruthTable(const fs::path& folder, const FrameClock& clock) {
  TruthTable table;
  table.camera.resize(clock.frames());
  table.objects.resize(clock.frames());
  if (!fs::is_directory(folder / "truth")) return table;
  const Truth truth = readTruth(folder);
  table.camera = posesByFrame(clock, truth.camera);
  for (const auto& [id, poses] : truth.bodies) table.bodies[id] = posesByFrame(clock, poses);
  for (const BodyVisibility& row : truth.visibility) {
    const auto frame = clock.frameOf(row.stamp_ns);
    const auto body = table.bodies.find(row.body);
    if (!frame || !table.camera[*frame] || body == table.bodies.end() || !body->second[*frame])
      continue;
    table.objects[*frame].push_back(row);
  }
  table.mask = truth.mask;
  return table;
}

}  // namespace

SequenceSource openSequenceFolder(const fs::path& folder) {
  SequenceSource source;
  source.info = readCalibration(folder / "calib.json");
  const std::vector<FrameTime> times = readTimes(folder / "times.txt");
  std::vector<std::int64_t> stamps;
  stamps.reserve(times.size());
  for (const FrameTime& time : times) stamps.push_back(time.stamp_ns);
  source.info.rate_hz = frameRate(stamps);
  source.frames = times.size();
  const auto truth = std::make_shared<const TruthTable>(readTruthTable(folder, FrameClock(stamps)));
  source.frame = [folder, times, truth, info = source.info](std::size_t k) {
    const std::string stem = sixDigits(times.at(k).number);
    SequenceFrame frame;
    frame.stamp_ns = times[k].stamp_ns;
    if (info.rgbd) {
      frame.left = readImage(folder / "rgb", stem, cv::IMREAD_COLOR, info.camera);
      frame.right = readImage(folder / "depth", stem, cv::IMREAD_UNCHANGED, info.camera);
      if (frame.right.type() != CV_16UC1)
        throw std::runtime_error((folder / "depth" / stem).string() + ".png is no 16-bit image");
    } else {
      frame.left = readImage(folder / "left", stem, cv::IMREAD_GRAYSCALE, info.camera);
      frame.right = readImage(folder / "right", stem, cv::IMREAD_GRAYSCALE, info.camera);
    }
    frame.T_world_camera = truth->camera[k];
    for (const auto& [id, poses] : truth->bodies)
      if (poses[k]) frame.T_world_bodies[id] = *poses[k];
    if (truth->mask) frame.mask = truth->mask(k);
    frame.objects = truth->objects[k];
    return frame;
  };
  return source;
}

}  // namespace mvo
