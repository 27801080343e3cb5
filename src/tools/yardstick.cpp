// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/yardstick.hpp"

#include <algorithm>
#include <ctime>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace mvo_tools {

namespace {

constexpr int kPoints = 1000;
constexpr int kRounds = 15;
constexpr int kColumns = 40;
constexpr int kRows = 25;

// Corners, filled up with a grid where the image has too few: the work per point is the same.
std::vector<cv::Point2f> thousandPoints(const cv::Mat& image) {
  std::vector<cv::Point2f> points;
  cv::goodFeaturesToTrack(image, points, kPoints, 1e-3, 4);
  for (int i = 0; static_cast<int>(points.size()) < kPoints; ++i)
    points.emplace_back(static_cast<float>(image.cols) * (i % kColumns + 0.5F) / kColumns,
                        static_cast<float>(image.rows) * (i / kColumns % kRows + 0.5F) / kRows);
  return points;
}

}  // namespace

YardstickPair::YardstickPair(const cv::Mat& from, const cv::Mat& to)
    : from_(from), to_(to), points_(thousandPoints(from)) {}

double YardstickPair::round() const {
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  std::vector<cv::Point2f> found;
  std::vector<unsigned char> status;
  std::vector<float> error;
  const double start = cpuMilliseconds();
  cv::calcOpticalFlowPyrLK(from_, to_, points_, found, status, error, cv::Size(21, 21), 3);
  const double spent = cpuMilliseconds() - start;
  cv::setNumThreads(threads);
  return spent;
}

double yardstickMilliseconds(const std::vector<std::pair<cv::Mat, cv::Mat>>& pairs) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : pairs) {
    const YardstickPair pair(from, to);
    for (int round = 0; round < kRounds; ++round) best = std::min(best, pair.round());
  }
  return pairs.empty() ? 0 : best;
}

double cpuMilliseconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

}  // namespace mvo_tools
