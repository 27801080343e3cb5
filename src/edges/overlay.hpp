// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of a result: the left image with its labelled tracklets and their tails.
#pragma once

#include <deque>
#include <map>
#include <opencv2/core.hpp>

#include "mvo/odometry.hpp"

namespace mvo_ros {

/// Draws one frame after the other; remembers where the tracklets came from.
class Overlay {
 public:
  explicit Overlay(const cv::Size& image);

  /// Size of the pictures: the image enlarged to at least 960 columns, a legend below; even
  /// numbers.
  cv::Size size() const { return canvas_; }
  /// The picture (8UC3) of a left image (8UC1) and what is known about it.
  cv::Mat draw(const cv::Mat& left, const mvo::MultimotionEstimate& estimate);

 private:
  struct Tail {
    mvo::FrameId last_frame = 0;
    std::deque<cv::Point2d> points;  // in the image [px], newest last
  };

  void remember(const mvo::MultimotionEstimate& estimate);
  cv::Point canvasPoint(const cv::Point2d& point) const;  // with kShift fractional bits
  void drawStatic(cv::Mat& picture, const mvo::LabeledPoint& point) const;
  void drawOutlier(cv::Mat& picture, const mvo::LabeledPoint& point) const;
  void drawMoving(cv::Mat& picture, const mvo::LabeledPoint& point) const;
  void drawIds(cv::Mat& picture, const mvo::MultimotionEstimate& estimate) const;
  void drawLegend(cv::Mat& picture, const mvo::MultimotionEstimate& estimate) const;

  cv::Size image_;
  int scale_;
  cv::Size canvas_;
  std::map<mvo::TrackletId, Tail> tails_;
};

}  // namespace mvo_ros
