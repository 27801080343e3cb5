// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Calibration files of Kalibr: a chain of cameras, and single transforms beside it.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace mvo {

/// One camera of a chain.
struct KalibrCamera {
  std::string topic;
  int width = 0;                   ///< [px]
  int height = 0;                  ///< [px]
  std::vector<double> intrinsics;  ///< fu fv cu cv [px]
  std::vector<double> distortion;  ///< k1 k2 p1 p2 (radtan), or empty
  Eigen::Isometry3d T_cn_c0 = Eigen::Isometry3d::Identity();
};

/// The cameras cam0, cam1, ... in order. Throws std::runtime_error naming the file.
std::vector<KalibrCamera> readKalibrChain(const std::filesystem::path& path);

/// A 4x4 transform by its name. Throws std::runtime_error naming the file.
Eigen::Isometry3d readKalibrTransform(const std::filesystem::path& path, const std::string& name);

}  // namespace mvo
