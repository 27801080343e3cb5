// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "io/atomic_file.hpp"
#include "io/stamp.hpp"
#include "mvo/sequence.hpp"

namespace mvo {
namespace {

std::string row(const SequenceFrame& frame, int number, const BodyVisibility& object) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s,%d,%d,%d,%.6f,%d,%.4f,%.4f\n",
                formatStamp(frame.stamp_ns).c_str(), number, object.body, object.visible_px,
                object.image_share, object.silhouette_px, object.inframe_share,
                object.visible_share);
  return text.data();
}

void writeText(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace

SequenceWriter::SequenceWriter(const std::filesystem::path& folder, const SequenceInfo& info)
    : folder_(folder),
      info_(info),
      objects_(
          "stamp,frame,id,visible_px,visible_image_frac,silhouette_px,inframe_frac,visible_"
          "frac\n") {
  for (const char* part : {info.rgbd ? "rgb" : "left", info.rgbd ? "depth" : "right", "truth"}) {
    std::filesystem::create_directories(folder / part);
  }
}

void SequenceWriter::writeImage(const std::string& part, const cv::Mat& image) const {
  std::array<char, 24> name{};
  std::snprintf(name.data(), name.size(), "%06d.png", frames_);
  const std::string path = (folder_ / part / name.data()).string();
  // The fastest compression: noise does not compress any better.
  if (!cv::imwrite(path, image, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
    throw std::runtime_error(path + " cannot be written");
  }
}

void SequenceWriter::add(const SequenceFrame& frame) {
  writeImage(info_.rgbd ? "rgb" : "left", frame.left);
  writeImage(info_.rgbd ? "depth" : "right", frame.right);
  if (!frame.mask.empty()) {
    std::filesystem::create_directories(folder_ / "truth" / "masks");
    writeImage("truth/masks", frame.mask);
  }
  times_ += std::to_string(frames_) + " " + formatStamp(frame.stamp_ns) + "\n";
  if (frame.T_world_camera) camera_.push_back({frame.stamp_ns, *frame.T_world_camera});
  for (const auto& [id, T_world_body] : frame.T_world_bodies) {
    bodies_[id].push_back({frame.stamp_ns, T_world_body});
  }
  for (const BodyVisibility& object : frame.objects) objects_ += row(frame, frames_, object);
  ++frames_;
}

std::string SequenceWriter::calibration() const {
  const StereoCamera& camera = info_.camera;
  nlohmann::ordered_json json;
  json["type"] = info_.rgbd ? "rgbd" : "stereo";
  json["width"] = camera.width;
  json["height"] = camera.height;
  json["fx"] = camera.fu;
  json["fy"] = camera.fv;
  json["cx"] = camera.cu;
  json["cy"] = camera.cv;
  json["baseline"] = info_.rgbd ? 0.0 : camera.baseline;
  json["fps"] = info_.rate_hz;
  if (info_.rgbd) json["depth_unit_m"] = 0.001;
  return json.dump(1) + "\n";
}

void SequenceWriter::finish() {
  if (!camera_.empty()) writeTum(folder_ / "truth" / "camera.tum", camera_);
  for (const auto& [id, poses] : bodies_) {
    writeTum(folder_ / "truth" / ("object_" + std::to_string(id) + ".tum"), poses);
  }
  if (!bodies_.empty()) writeText(folder_ / "truth" / "objects.csv", objects_);
  writeText(folder_ / "times.txt", times_);
  writeText(folder_ / "calib.json", calibration());
}

}  // namespace mvo
