// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_session.hpp"

#include <chrono>
#include <sstream>
#include <stdexcept>

#include "image_conversion.hpp"

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

OdometrySession::OdometrySession(const SensorSetup& setup, const mvo::Options& options)
    : setup_(setup), options_(options) {}

void OdometrySession::reset(const std::string& reason) {
  if (odometry_) restart_ = reason;
}

void OdometrySession::setOptions(const mvo::Options& options) {
  if (odometry_) odometry_->setOptions(options);
  options_ = options;
}

// Takes the set's calibration; a new one starts a new world.
void OdometrySession::adopt(const InputSet& set) {
  const std::string calibration =
      fingerprint(*set.left_info) + (set.second_info ? fingerprint(*set.second_info) : "");
  if (model_ && calibration == calibration_) return;
  const SensorModel model(setup_, *set.left_info,
                          set.second_info ? *set.second_info : sensor_msgs::CameraInfo());
  auto odometry = std::make_unique<mvo::MultimotionOdometry>(model.camera(), options_);
  if (odometry_) restart_ = "the calibration has changed";
  calibration_ = calibration;
  model_ = model;
  odometry_ = std::move(odometry);
}

cv::Mat OdometrySession::checked(const cv::Mat& image, const std::string& topic) const {
  const mvo::StereoCamera& camera = model_->camera();
  if (image.cols != camera.width || image.rows != camera.height)
    throw std::runtime_error("topic " + topic + ": the image has " + std::to_string(image.cols) +
                             "x" + std::to_string(image.rows) + " pixels, but the calibration (" +
                             setup_.topics.left_info + ") is for " + std::to_string(camera.width) +
                             "x" + std::to_string(camera.height));
  return image;
}

Step OdometrySession::add(const InputSet& set) {
  const auto start = std::chrono::steady_clock::now();
  const bool depth = setup_.sensor == Sensor::kRgbd;
  const cv::Mat left = read(*set.left, false, setup_.topics.left);
  const cv::Mat second = read(*set.second, depth, setup_.topics.second);
  adopt(set);
  const ros::Time stamp = set.left->header.stamp;
  const mvo::Frame frame =
      model_->frame(static_cast<std::int64_t>(stamp.toNSec()), checked(left, setup_.topics.left),
                    checked(second, setup_.topics.second));

  Step step;
  step.decode_ms = millisecondsSince(start);
  if (!stamps_.empty() && stamp == last_stamp_)
    throw std::runtime_error("topic " + setup_.topics.left + ": a second image with stamp " +
                             std::to_string(stamp.toSec()) + " s is passed over");
  if (!stamps_.empty() && stamp < last_stamp_ && !restart_)
    restart_ = "time went back by " + std::to_string((last_stamp_ - stamp).toSec()) + " s";
  if (restart_) {
    odometry_->reset();
    stamps_.clear();
    last_left_.release();
    T_world_camera_.setIdentity();
    ++resets_;
    step.restarted = true;
    step.notice = "the world starts anew: " + *restart_;
    restart_.reset();
  }
  frozen_ = same(frame.left, last_left_) ? frozen_ + 1 : 0;
  if (frozen_ >= kFrozen && step.notice.empty())
    step.notice = "topic " + setup_.topics.left + ": the last " + std::to_string(frozen_ + 1) +
                  " images are the same";
  last_left_ = frame.left;

  if (!stamps_.empty()) step.period = (stamp - last_stamp_).toSec();
  if (step.period && *step.period > kLongGap && step.notice.empty())
    step.notice =
        "no images for " + std::to_string(*step.period) +
        " s: how the camera moved meanwhile is known only as far as it sees the same again";
  last_stamp_ = stamp;
  step.estimate = odometry_->addFrame(frame);
  stamps_[step.estimate.frame] = stamp;
  stamps_.erase(stamps_.begin(), stamps_.lower_bound(step.estimate.window_begin));
  if (step.estimate.valid) T_world_camera_ = step.estimate.motions.front().T_world_motion;

  step.camera = model_->camera();
  step.left = frame.left;
  step.camera_frame_id = set.left->header.frame_id;
  step.stamp = stamp;
  step.stamps = stamps_;
  step.T_world_camera = T_world_camera_;
  step.resets = resets_;
  step.arrival = set.arrival;
  step.total_ms = millisecondsSince(start);
  return step;
}

}  // namespace mvo_ros
