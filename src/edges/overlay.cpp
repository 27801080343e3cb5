// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/overlay.hpp"

#include <opencv2/imgproc.hpp>
#include <string>

#include "edges/motion_color.hpp"

namespace mvo_ros {

namespace {

constexpr int kLeastWidth = 960;  // thin lines survive a video's coarse colours from here on
constexpr int kLegendHeight = 32;
constexpr std::size_t kTail = 10;  // observations
constexpr mvo::FrameId kMaxGap = 3;
constexpr int kShift = 4;  // fractional bits of coordinates that are drawn
constexpr double kDim = 0.72;
constexpr double kTextSize = 0.5;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

const cv::Scalar kTextColor(225, 225, 225);
const cv::Scalar kLegendColor(32, 32, 32);

cv::Scalar motionColor(mvo::LabelId id) {
  const auto [red, green, blue] = mvo::motionColor(id);
  return cv::Scalar(blue, green, red);
}

void outlinedText(cv::Mat& picture, const std::string& text, const cv::Point& at, double size,
                  const cv::Scalar& color) {
  cv::putText(picture, text, at, kFont, size, cv::Scalar::all(0), 6, cv::LINE_AA);
  cv::putText(picture, text, at, kFont, size, color, 2, cv::LINE_AA);
}

// How many tracklets a motion has: in the window if it is estimated, else in this frame.
std::map<mvo::LabelId, int> supports(const mvo::MultimotionEstimate& estimate) {
  std::map<mvo::LabelId, int> out;
  for (const auto& point : estimate.points) ++out[point.id];
  for (const auto& motion : estimate.motions) out[motion.id] = motion.support;
  return out;
}

int nextEven(int n) { return n + n % 2; }

}  // namespace

Overlay::Overlay(const cv::Size& image)
    : image_(image),
      scale_((kLeastWidth + image.width - 1) / image.width),
      canvas_(nextEven(image.width * scale_), nextEven(image.height * scale_ + kLegendHeight)) {}

cv::Mat Overlay::draw(const cv::Mat& left, const mvo::MultimotionEstimate& estimate) {
  remember(estimate);
  cv::Mat picture(canvas_, CV_8UC3, kLegendColor);
  cv::Mat grey;
  cv::resize(left, grey, image_ * scale_, 0, 0, cv::INTER_LINEAR);
  cv::cvtColor(grey * kDim, grey, cv::COLOR_GRAY2BGR);
  grey.copyTo(picture(cv::Rect(cv::Point(0, 0), grey.size())));

  for (const auto& point : estimate.points)
    if (point.id == mvo::kStatic) drawStatic(picture, point);
  for (const auto& point : estimate.points)
    if (point.id < mvo::kStatic) drawOutlier(picture, point);
  for (const auto& point : estimate.points)
    if (point.id > mvo::kStatic) drawMoving(picture, point);
  drawIds(picture, estimate);
  drawLegend(picture, estimate);
  return picture;
}

void Overlay::remember(const mvo::MultimotionEstimate& estimate) {
  for (const auto& point : estimate.points) {
    Tail& tail = tails_[point.tracklet];
    tail.last_frame = estimate.frame;
    tail.points.emplace_back(point.y.x(), point.y.y());
    if (tail.points.size() > kTail) tail.points.pop_front();
  }
  for (auto it = tails_.begin(); it != tails_.end();)
    it = it->second.last_frame + kMaxGap < estimate.frame ? tails_.erase(it) : std::next(it);
}

cv::Point Overlay::canvasPoint(const cv::Point2d& point) const {
  const auto fixed = [this](double x) {  // the centre of pixel 0 is 0, also after enlarging
    return cvRound(((x + 0.5) * scale_ - 0.5) * (1 << kShift));
  };
  return {fixed(point.x), fixed(point.y)};
}

void Overlay::drawStatic(cv::Mat& picture, const mvo::LabeledPoint& point) const {
  cv::circle(picture, canvasPoint({point.y.x(), point.y.y()}), 3 << (kShift - 1),
             motionColor(mvo::kStatic), cv::FILLED, cv::LINE_AA, kShift);
}

void Overlay::drawOutlier(cv::Mat& picture, const mvo::LabeledPoint& point) const {
  const cv::Point center = canvasPoint({point.y.x(), point.y.y()});
  const int arm = 3 << kShift;
  for (const cv::Point& d : {cv::Point(arm, arm), cv::Point(arm, -arm)})
    cv::line(picture, center - d, center + d, motionColor(mvo::kOutlier), 1, cv::LINE_AA, kShift);
}

void Overlay::drawMoving(cv::Mat& picture, const mvo::LabeledPoint& point) const {
  const cv::Scalar color = motionColor(point.id);
  const auto& points = tails_.at(point.tracklet).points;
  for (std::size_t i = 1; i < points.size(); ++i) {  // fades towards the past
    const double age = static_cast<double>(points.size() - i) / kTail;
    cv::line(picture, canvasPoint(points[i - 1]), canvasPoint(points[i]), color * (1.0 - 0.6 * age),
             1, cv::LINE_AA, kShift);
  }
  cv::circle(picture, canvasPoint(points.back()), 3 << kShift, color, cv::FILLED, cv::LINE_AA,
             kShift);
}

void Overlay::drawIds(cv::Mat& picture, const mvo::MultimotionEstimate& estimate) const {
  std::map<mvo::LabelId, std::pair<cv::Point2d, int>> sums;
  for (const auto& point : estimate.points) {
    auto& [sum, count] = sums[point.id];
    sum += cv::Point2d(point.y.x(), point.y.y());
    ++count;
  }
  for (const auto& [id, sum_count] : sums) {
    if (id <= mvo::kStatic) continue;
    const cv::Point2d center = sum_count.first / sum_count.second;
    const cv::Point offset(8, -8);  // beside, not on, the points
    outlinedText(picture, std::to_string(id), cv::Point(center * scale_) + offset, 0.9,
                 motionColor(id));
  }
}

void Overlay::drawLegend(cv::Mat& picture, const mvo::MultimotionEstimate& estimate) const {
  const int middle = image_.height * scale_ + kLegendHeight / 2;
  int x = 12;
  const auto write = [&](const std::string& text, const cv::Scalar& color) {
    cv::putText(picture, text, {x, middle + 5}, kFont, kTextSize, color, 1, cv::LINE_AA);
    x += cv::getTextSize(text, kFont, kTextSize, 1, nullptr).width + 22;
  };
  write("frame " + std::to_string(estimate.frame), kTextColor);
  if (!estimate.valid) return write("no estimate: " + estimate.problem, motionColor(mvo::kOutlier));
  for (const auto& [id, support] : supports(estimate)) {
    cv::circle(picture, {x, middle}, 5, motionColor(id), cv::FILLED, cv::LINE_AA);
    x += 12;
    const std::string name = id < mvo::kStatic    ? "outliers"
                             : id == mvo::kStatic ? "static"
                                                  : "motion " + std::to_string(id);
    write(name + ": " + std::to_string(support), kTextColor);
  }
}

}  // namespace mvo_ros
