// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/stereo_camera.hpp"

#include <cmath>
#include <stdexcept>

namespace mvo {

Eigen::Vector3d StereoCamera::project(const Eigen::Vector3d& p) const {
  const double w = 1.0 / p.z();
  const double u = fu * p.x() * w + cu;
  return {u, fv * p.y() * w + cv, u - fu * baseline * w};
}

Eigen::Vector3d StereoCamera::backProject(const Eigen::Vector3d& y) const {
  const double z = fu * baseline / (y.x() - y.z());
  return {(y.x() - cu) * z / fu, (y.y() - cv) * z / fv, z};
}

void StereoCamera::validate() const {
  const auto require = [](bool ok, const std::string& what) {
    if (!ok) throw std::invalid_argument("camera calibration: " + what);
  };
  require(width > 0 && height > 0, "the image size is " + std::to_string(width) + "x" +
                                       std::to_string(height) + ", it must be positive");
  require(std::isfinite(fu) && std::isfinite(fv) && fu > 0 && fv > 0,
          "the focal lengths are " + std::to_string(fu) + " and " + std::to_string(fv) +
              " px, they must be positive");
  require(std::isfinite(cu) && std::isfinite(cv), "the principal point is not finite");
  require(std::isfinite(baseline) && baseline > 0,
          "the baseline is " + std::to_string(baseline) +
              " m, it must be positive (the right camera_info's P[3] is -fx * baseline)");
}

}  // namespace mvo
