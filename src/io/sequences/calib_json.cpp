// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequences/calib_json.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "io/camera_json.hpp"

namespace mvo {

SequenceInfo readCalibration(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  SequenceInfo info;
  try {
    const auto json = nlohmann::json::parse(file);
    const std::string type = json.at("type").get<std::string>();
    if (type != "stereo" && type != "rgbd")
      throw std::runtime_error("type is '" + type + "', neither stereo nor rgbd");
    info.rgbd = type == "rgbd";
    info.camera = intrinsicsOf(json);
    StereoCamera& camera = info.camera;
    camera.baseline = json.value("baseline", 0.0);
    StereoCamera valid = camera;
    if (info.rgbd) valid.baseline = 1;  // depth images need none
    valid.validate();
    if (info.rgbd && json.value("depth_unit_m", 0.001) != 0.001)
      throw std::runtime_error("depth_unit_m must be 0.001");
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return info;
}

}  // namespace mvo
