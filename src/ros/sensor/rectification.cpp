// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/rectification.hpp"

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/distortion_models.h>

#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace mvo_ros {

namespace {

constexpr char kEquidistant[] = "equidistant";  // no name for it in older sensor_msgs

}  // namespace

// image_geometry's own rectifyImage() copies the image whenever there is no distortion, also if R
// or P ask for a rotation, so only its handling of binning and region of interest is used.
Rectification::Rectification(const sensor_msgs::CameraInfo& info, const std::string& topic) {
  const auto refuse = [&topic](const std::string& problem) {
    throw std::runtime_error("topic " + topic + ": " + problem);
  };
  if (!(info.K[0] > 0) || !(info.K[4] > 0))
    refuse("the focal lengths K[0] = " + std::to_string(info.K[0]) + " and K[4] = " +
           std::to_string(info.K[4]) + " px must be positive to rectify raw images");
  sensor_msgs::CameraInfo without_distortion = info;  // the model may not know every kind
  without_distortion.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  without_distortion.D.clear();
  image_geometry::PinholeCameraModel camera;
  camera.fromCameraInfo(without_distortion);

  const cv::Mat K(camera.intrinsicMatrix());
  const cv::Mat P(camera.projectionMatrix().get_minor<3, 3>(0, 0));
  cv::Mat R(camera.rotationMatrix());
  if (cv::countNonZero(R) == 0) R = cv::Mat::eye(3, 3, CV_64F);  // drivers that leave R unset
  const cv::Mat D(info.D, true);
  const cv::Size size = camera.reducedResolution();
  try {
    if (info.distortion_model == kEquidistant) {
      cv::fisheye::initUndistortRectifyMap(K, D, R, P, size, CV_16SC2, map_, interpolation_);
    } else if (info.distortion_model == sensor_msgs::distortion_models::PLUMB_BOB ||
               info.distortion_model == sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL ||
               info.distortion_model.empty()) {
      cv::initUndistortRectifyMap(K, D, R, P, size, CV_16SC2, map_, interpolation_);
    } else {
      refuse("the distortion model '" + info.distortion_model +
             "' is unknown: give plumb_bob, rational_polynomial or equidistant");
    }
  } catch (const cv::Exception&) {
    refuse("the distortion model '" + info.distortion_model + "' does not go with " +
           std::to_string(info.D.size()) + " coefficients");
  }
}

cv::Mat Rectification::grey(const cv::Mat& raw) const {
  cv::Mat out;
  cv::remap(raw, out, map_, interpolation_, cv::INTER_LINEAR);
  return out;
}

cv::Mat Rectification::depth(const cv::Mat& raw) const {
  cv::Mat out;
  cv::remap(raw, out, map_, interpolation_, cv::INTER_NEAREST, cv::BORDER_CONSTANT,
            cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
  return out;
}

}  // namespace mvo_ros
