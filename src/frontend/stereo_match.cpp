// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/frontend/stereo_match.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mvo {

std::optional<double> searchDisparity(const cv::Mat& left, const cv::Mat& right,
                                      const cv::Point2f& p, const StereoSearch& search) {
  const int half = search.patch / 2;
  const int u = cvRound(p.x);
  const int v = cvRound(p.y);
  if (u < half || v < half || u + half >= left.cols || v + half >= left.rows) return std::nullopt;
  const int first = std::max(half, u - static_cast<int>(search.max_disparity));
  const int last =
      std::min(right.cols - 1 - half, u + 2);  // a little beyond infinity, for its slope
  const cv::Rect strip(first - half, v - half, last - first + search.patch, search.patch);
  cv::Mat score;
  cv::matchTemplate(right(strip), left(cv::Rect(u - half, v - half, search.patch, search.patch)),
                    score, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point where;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &where);
  if (!(best >= search.min_correlation)) return std::nullopt;
  for (int i = 0; i < score.cols; ++i) {
    const float s = score.at<float>(i);
    const bool peak = (i == 0 || s >= score.at<float>(i - 1)) &&
                      (i + 1 == score.cols || s >= score.at<float>(i + 1));
    if (peak && std::abs(i - where.x) > 2 && s > search.max_rival * best) return std::nullopt;
  }
  return u - (first + where.x);
}

}  // namespace mvo
