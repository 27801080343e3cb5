// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/odometry_session.hpp"

#include <chrono>
#include <sstream>
#include <stdexcept>

#include "ros/sensor/image_conversion.hpp"

namespace mvo_ros {

namespace {

constexpr int kFrozen = 3;      // frames alike before it is said
constexpr double kLongGap = 1;  // s between frames after which it is said

// All of a calibration but its header.
std::string fingerprint(const sensor_msgs::CameraInfo& info) {
  sensor_msgs::CameraInfo copy = info;
  copy.header = std_msgs::Header();
  std::ostringstream text;
  text.precision(17);
  text << copy;
  return text.str();
}

cv::Mat read(const sensor_msgs::Image& message, bool depth, const std::string& topic) {
  try {
    return depth ? depthImage(message) : greyImage(message);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("topic " + topic + ": " + error.what());
  }
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

SetPreparation::SetPreparation(const SensorSetup& setup, const mvo::Options& options)
    : setup_(setup), options_(options) {}

void SetPreparation::setCameraErrors(mvo::LearntCameraErrors learnt, std::string source) {
  camera_errors_ = std::move(learnt);
  camera_errors_source_ = std::move(source);
}

void SetPreparation::adopt(const InputSet& set) {
  const std::string calibration =
      fingerprint(*set.left_info) + (set.second_info ? fingerprint(*set.second_info) : "");
  if (calibrated_ && calibration == fingerprint_) return;
  const SensorModel model(setup_, *set.left_info,
                          set.second_info ? *set.second_info : sensor_msgs::CameraInfo());
  const auto calibrated = std::make_shared<CalibratedOdometry>(
      CalibratedOdometry{model, mvo::MultimotionOdometry(model.camera(), options_)});
  if (camera_errors_) {
    try {
      calibrated->odometry.setCameraErrors(*camera_errors_);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(camera_errors_source_ + ": " + error.what());
    }
  }
  calibrated_ = calibrated;
  fingerprint_ = calibration;
}

cv::Mat SetPreparation::checked(const cv::Mat& image, const std::string& topic) const {
  const mvo::StereoCamera& camera = calibrated_->model.camera();
  if (image.cols != camera.width || image.rows != camera.height)
    throw std::runtime_error("topic " + topic + ": the image has " + std::to_string(image.cols) +
                             "x" + std::to_string(image.rows) + " pixels, but the calibration (" +
                             setup_.topics.left_info + ") is for " + std::to_string(camera.width) +
                             "x" + std::to_string(camera.height));
  return image;
}

PreparedSet SetPreparation::prepare(const InputSet& set) {
  const auto start = std::chrono::steady_clock::now();
  const bool depth = setup_.sensor == Sensor::kRgbd;
  const cv::Mat left = read(*set.left, false, setup_.topics.left);
  const cv::Mat second = read(*set.second, depth, setup_.topics.second);
  adopt(set);
  mvo::Frame frame = calibrated_->model.frame(
      static_cast<std::int64_t>(set.left->header.stamp.toNSec()), checked(left, setup_.topics.left),
      checked(second, setup_.topics.second));
  requireSize(mask_, frame.left.size());
  frame.mask = mask_.image;
  PreparedSet out;
  out.set = set;
  out.calibrated = calibrated_;
  out.left = frame.left;
  out.decode_ms = millisecondsSince(start);
  out.frame = mvo::prepareFrame(frame, calibrated_->model.camera(), options_.frontend);
  return out;
}

OdometrySession::OdometrySession(SensorTopics topics, const mvo::Options& options)
    : topics_(std::move(topics)), options_(options) {}

void OdometrySession::reset(const std::string& reason) {
  if (calibrated_) restart_ = reason;
}

void OdometrySession::setOptions(const mvo::Options& options) {
  if (calibrated_) calibrated_->odometry.setOptions(options);
  options_ = options;
}

void OdometrySession::adopt(const PreparedSet& prepared) {
  if (calibrated_ == prepared.calibrated) return;
  if (calibrated_) restart_ = "the calibration has changed";
  calibrated_ = prepared.calibrated;
  calibrated_->odometry.setOptions(options_);  // which may have changed since it was made
}

Step OdometrySession::add(PreparedSet prepared) {
  const auto start = std::chrono::steady_clock::now();
  const std_msgs::Header& header = prepared.set.left->header;
  const ros::Time stamp = header.stamp;
  adopt(prepared);
  mvo::MultimotionOdometry& odometry = calibrated_->odometry;

  Step step;
  step.decode_ms = prepared.decode_ms;
  step.before_ms = prepared.decode_ms + prepared.frame.prepare_ms;
  if (!stamps_.empty() && stamp == last_stamp_)
    throw std::runtime_error("topic " + topics_.left + ": a second image with stamp " +
                             std::to_string(stamp.toSec()) + " s is passed over");
  if (!stamps_.empty() && stamp < last_stamp_ && !restart_)
    restart_ = "time went back by " + std::to_string((last_stamp_ - stamp).toSec()) + " s";
  if (restart_) {
    odometry.reset();
    stamps_.clear();
    last_left_.release();
    ++resets_;
    step.restarted = true;
    step.notice = "the world starts anew: " + *restart_;
    restart_.reset();
  }
  frozen_ = same(prepared.left, last_left_) ? frozen_ + 1 : 0;
  if (frozen_ >= kFrozen && step.notice.empty())
    step.notice = "topic " + topics_.left + ": the last " + std::to_string(frozen_ + 1) +
                  " images are the same";
  last_left_ = prepared.left;

  if (!stamps_.empty()) step.period = (stamp - last_stamp_).toSec();
  if (step.period && *step.period > kLongGap && step.notice.empty())
    step.notice =
        "no images for " + std::to_string(*step.period) +
        " s: how the camera moved meanwhile is known only as far as it sees the same again";
  last_stamp_ = stamp;
  step.estimate = odometry.addFrame(std::move(prepared.frame));
  stamps_[step.estimate.frame] = stamp;
  stamps_.erase(stamps_.begin(), stamps_.lower_bound(step.estimate.window_begin));
  if (step.notice.empty()) step.notice = step.estimate.notice;

  step.camera_errors = odometry.cameraErrors();
  step.left_info = prepared.set.left_info;
  step.second_info = prepared.set.second_info;
  step.camera = calibrated_->model.camera();
  step.left = prepared.left;
  step.camera_frame_id = header.frame_id;
  step.stamp = stamp;
  step.stamps = stamps_;
  step.T_world_camera = step.estimate.T_world_camera;
  step.resets = resets_;
  step.arrival = prepared.set.arrival;
  step.total_ms = step.before_ms + millisecondsSince(start);
  return step;
}

}  // namespace mvo_ros
