// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/camera_from_info.hpp"

#include <image_geometry/pinhole_camera_model.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mvo_ros {

namespace {

constexpr double kSameFocalLength = 1e-3;    // relative
constexpr double kSamePrincipalPoint = 0.1;  // [px]

[[noreturn]] void refuse(const std::string& topic, const std::string& problem) {
  throw std::runtime_error("topic " + topic + ": " + problem);
}

image_geometry::PinholeCameraModel model(const sensor_msgs::CameraInfo& info,
                                         const std::string& topic) {
  const auto zero = [](double x) { return x == 0; };
  if (std::all_of(info.P.begin(), info.P.end(), zero))
    refuse(topic, std::all_of(info.K.begin(), info.K.end(), zero)
                      ? "the calibration is all zero (the camera was not calibrated)"
                      : "the calibration has no projection matrix (P is all zero)");
  if (!std::all_of(info.P.begin(), info.P.end(), [](double x) { return std::isfinite(x); }))
    refuse(topic, "the calibration's projection matrix P is not finite");
  if (!(info.P[0] > 0) || !(info.P[5] > 0))
    refuse(topic, "the focal lengths P[0] = " + std::to_string(info.P[0]) +
                      " and P[5] = " + std::to_string(info.P[5]) + " px must be positive");
  if (info.width == 0 || info.height == 0)
    refuse(topic, "the calibration does not say the image size (width and height are 0)");
  image_geometry::PinholeCameraModel camera;
  try {
    camera.fromCameraInfo(info);
  } catch (const std::exception& error) {
    refuse(topic, std::string("the calibration cannot be used: ") + error.what());
  }
  return camera;
}

mvo::StereoCamera withoutBaseline(const image_geometry::PinholeCameraModel& camera) {
  mvo::StereoCamera out;
  out.fu = camera.fx();
  out.fv = camera.fy();
  out.cu = camera.cx();
  out.cv = camera.cy();
  out.width = camera.reducedResolution().width;
  out.height = camera.reducedResolution().height;
  return out;
}

}  // namespace

mvo::StereoCamera stereoCamera(const sensor_msgs::CameraInfo& left,
                               const sensor_msgs::CameraInfo& right, const std::string& left_topic,
                               const std::string& right_topic) {
  const auto l = model(left, left_topic);
  const auto r = model(right, right_topic);
  const double baseline = -r.Tx() / r.fx();
  if (baseline == 0)
    refuse(right_topic,
           "the calibration has no baseline: P[3] is 0, it must be -fx * baseline [px m]");
  if (!(baseline > 0))
    refuse(right_topic, "the baseline is " + std::to_string(baseline) +
                            " m, it must be positive (P[3] = -fx * baseline): are left and right "
                            "swapped?");
  const auto size = [](const image_geometry::PinholeCameraModel& camera) {
    return std::to_string(camera.reducedResolution().width) + "x" +
           std::to_string(camera.reducedResolution().height);
  };
  if (l.reducedResolution() != r.reducedResolution())
    refuse(right_topic, "the calibration is for " + size(r) + " pixels, but " + left_topic +
                            "'s is for " + size(l));
  const auto differ = [](double a, double b, double tolerance) {
    return std::abs(a - b) > tolerance;
  };
  if (differ(l.fx(), r.fx(), kSameFocalLength * l.fx()) ||
      differ(l.fy(), r.fy(), kSameFocalLength * l.fy()) ||
      differ(l.cx(), r.cx(), kSamePrincipalPoint) || differ(l.cy(), r.cy(), kSamePrincipalPoint))
    refuse(right_topic, "the focal lengths and principal point in P differ from " + left_topic +
                            "'s: the images are not a rectified pair with zero disparity at "
                            "infinity (raw images can be rectified here)");
  mvo::StereoCamera camera = withoutBaseline(l);
  camera.baseline = baseline;
  return camera;
}

mvo::StereoCamera rgbdCamera(const sensor_msgs::CameraInfo& color, double baseline,
                             const std::string& topic) {
  mvo::StereoCamera camera = withoutBaseline(model(color, topic));
  camera.baseline = baseline;
  return camera;
}

sensor_msgs::CameraInfo alignedRight(const sensor_msgs::CameraInfo& left,
                                     sensor_msgs::CameraInfo right) {
  if (!(right.P[0] > 0) || !(left.P[0] > 0)) return right;  // stereoCamera() says what is wrong
  const double baseline = -right.P[3] / right.P[0];
  right.P = left.P;
  right.P[3] = -left.P[0] * baseline;
  return right;
}

}  // namespace mvo_ros
