// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/camera_error_outputs.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "mvo/camera_error_files.hpp"
#include "ros/sensor/corrected_info.hpp"

namespace mvo_ros {

namespace {

constexpr double kNoticeable = 0.05;  // [px]
constexpr double kEvery = 2;          // [s]
constexpr double kLeastDelay = 1;     // that is said to be left [ms]

std::string sentence(const CorrectedInfo& corrected, const mvo::CameraErrorReport& report) {
  char text[256];
  std::snprintf(text, sizeof text,
                "%s; rectified by this calibration of the right camera, %.2f px rms of %.2f px are "
                "left",
                report.significant ? report.advice.c_str() : "nothing significant was found",
                corrected.after_rms, corrected.before_rms);
  std::string out = text;
  if (report.significant && std::abs(report.delay.value) > kLeastDelay)
    out += ", and what the delay does, which no calibration says";
  return out;
}

}  // namespace

mvo::CameraErrors cameraErrorsMessage(const std_msgs::Header& header,
                                      const mvo::CameraErrorReport& report) {
  mvo::CameraErrors out;
  out.header = header;
  out.significant = static_cast<std::uint8_t>(report.significant);
  out.advice = report.advice;
  const auto set = [](double& value, double& deviation, const mvo::Measured& measured) {
    value = measured.value;
    deviation = measured.deviation;
  };
  set(out.disparity, out.disparity_sd, report.disparity);
  set(out.disparity_rms, out.disparity_rms_sd, report.disparity_rms);
  set(out.rows, out.rows_sd, report.rows);
  set(out.rows_rms, out.rows_rms_sd, report.rows_rms);
  set(out.yaw, out.yaw_sd, report.yaw);
  set(out.pitch, out.pitch_sd, report.pitch);
  set(out.roll, out.roll_sd, report.roll);
  set(out.focal, out.focal_sd, report.focal);
  set(out.delay, out.delay_sd, report.delay);
  for (const mvo::CameraErrorTerm& term : report.terms) {
    out.terms.push_back(term.name);
    out.units.push_back(term.unit);
    out.values.push_back(term.measured.value);
  }
  const Eigen::MatrixXd& covariance = report.learnt.covariance;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i)
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) out.covariance.push_back(covariance(i, j));
  return out;
}

bool isWorthSaying(const mvo::CameraErrors& now, const mvo::CameraErrors& last) {
  const auto moved = [](double a, double b) { return std::abs(a - b) > kNoticeable; };
  return now.significant != last.significant || moved(now.disparity, last.disparity) ||
         moved(now.disparity_rms, last.disparity_rms) || moved(now.rows, last.rows) ||
         moved(now.rows_rms, last.rows_rms) ||
         std::abs((now.header.stamp - last.header.stamp).toSec()) >= kEvery;
}

CameraErrorOutputs::CameraErrorOutputs(ros::NodeHandle pnh)
    : topic_(pnh.advertise<mvo::CameraErrors>("camera_errors", 1, true)) {
  services_.push_back(
      pnh.advertiseService("get_camera_info", &CameraErrorOutputs::onGetCameraInfo, this));
  services_.push_back(
      pnh.advertiseService("save_camera_errors", &CameraErrorOutputs::onSave, this));
}

void CameraErrorOutputs::step(const Step& step) {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_ = {step.camera_errors, step.left_info, step.second_info};
  if (!step.camera_errors) return;
  std_msgs::Header header;
  header.stamp = step.stamp;
  header.frame_id = step.camera_frame_id;
  const mvo::CameraErrors message = cameraErrorsMessage(header, *step.camera_errors);
  if (said_ && !isWorthSaying(message, *said_)) return;
  topic_.publish(message);
  said_ = message;
}

CameraErrorOutputs::Known CameraErrorOutputs::known() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!known_) throw std::runtime_error("there is no estimate yet");
  if (!known_->report || !known_->right)
    throw std::runtime_error(
        "the camera's errors are not learnt: camera.errors is off, or depth is sensed");
  return *known_;
}

bool CameraErrorOutputs::onGetCameraInfo(mvo::GetCameraInfo::Request&,
                                         mvo::GetCameraInfo::Response& response) {
  response.success = 0;
  try {
    const Known known = this->known();
    const CorrectedInfo corrected = correctedRight(*known.right, known.report->learnt);
    response.left = *known.left;
    response.right = corrected.right;
    response.message = sentence(corrected, *known.report);
    response.success = 1;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool CameraErrorOutputs::onSave(mvo::SaveCameraErrors::Request& request,
                                mvo::SaveCameraErrors::Response& response) {
  response.success = 0;
  try {
    if (!std::filesystem::path(request.file).is_absolute())
      throw std::runtime_error("the file '" + request.file + "' must be an absolute path");
    mvo::writeCameraErrors(request.file, known().report->learnt);
    response.message = request.file;
    response.success = 1;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

}  // namespace mvo_ros
