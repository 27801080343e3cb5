// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "mvo/stereo_camera.hpp"

namespace mvo {

/// The keys width, height, fx, fy, cx, cy; the baseline is left to the caller, since RGB-D files
/// have none.
inline StereoCamera intrinsicsOf(const nlohmann::json& json) {
  StereoCamera camera;
  camera.width = json.at("width").get<int>();
  camera.height = json.at("height").get<int>();
  camera.fu = json.at("fx").get<double>();
  camera.fv = json.at("fy").get<double>();
  camera.cu = json.at("cx").get<double>();
  camera.cv = json.at("cy").get<double>();
  return camera;
}

}  // namespace mvo
