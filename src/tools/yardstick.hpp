// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A unit of computing time that goes with the machine, so that step times can be compared between
// machines.
#pragma once

#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace mvo_tools {

/// Y [ms]: CPU time of OpenCV's pyramidal Lucas-Kanade for 1000 points from the first to the second
/// image of a pair (21x21 windows, 3 levels, pyramids included, one thread), best of several
/// rounds. 0 without pairs.
double yardstickMilliseconds(const std::vector<std::pair<cv::Mat, cv::Mat>>& pairs);

/// The same, round by round: for timings that take turns with it, as a machine's speed drifts.
class YardstickPair {
 public:
  YardstickPair(const cv::Mat& from, const cv::Mat& to);

  /// CPU time of one round [ms]; leaves OpenCV's number of threads as it is.
  double round() const;

 private:
  cv::Mat from_;
  cv::Mat to_;
  std::vector<cv::Point2f> points_;
};

/// CPU time that this process has used so far [ms].
double cpuMilliseconds();

}  // namespace mvo_tools
