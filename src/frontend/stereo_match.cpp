// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/stereo_match.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

#include "kernels/patch.hpp"

namespace mvo {

namespace {

constexpr int kMaxSide = 31;            // of a patch [px]
constexpr float kLeastVariance = 0.5F;  // of a patch [grey levels^2]

}  // namespace

std::optional<double> searchDisparity(const cv::Mat& left, const cv::Mat& right,
                                      const cv::Point2f& p, const StereoSearch& search) {
  assert(search.patch <= kMaxSide);
  const int half = search.patch / 2;
  const int u = cvRound(p.x);
  const int v = cvRound(p.y);
  if (u < half || v < half || u + half >= left.cols || v + half >= left.rows) return std::nullopt;
  const int first = std::max(half, u - static_cast<int>(search.max_disparity));
  const int last =
      std::min(right.cols - 1 - half, u + 2);  // a little beyond infinity, for its slope
  if (last < first) return std::nullopt;
  const int n = search.patch * search.patch;
  std::array<float, kMaxSide * kMaxSide> patch;
  for (int y = 0; y < search.patch; ++y)
    for (int x = 0; x < search.patch; ++x)
      patch[y * search.patch + x] = left.ptr(v - half + y)[u - half + x];
  const float mean =
      std::accumulate(patch.begin(), patch.begin() + n, 0.0F) / static_cast<float>(n);
  float square = 0;
  for (int i = 0; i < n; ++i) {
    patch[i] -= mean;
    square += patch[i] * patch[i];
  }
  if (square < kLeastVariance * static_cast<float>(n)) return std::nullopt;
  for (int i = 0; i < n; ++i) patch[i] /= std::sqrt(square);

  std::vector<float> score(static_cast<std::size_t>(last - first + 1));
  rowCorrelations(right.ptr(v - half) + first - half, static_cast<std::ptrdiff_t>(right.step),
                  search.patch, patch.data(), static_cast<int>(score.size()), score.data());
  const auto best = std::max_element(score.begin(), score.end());
  if (!(*best >= search.min_correlation)) return std::nullopt;
  for (auto s = score.begin(); s != score.end(); ++s) {
    const bool peak = (s == score.begin() || *s >= s[-1]) && (s + 1 == score.end() || *s >= s[1]);
    if (peak && std::abs(s - best) > 2 && *s > search.max_rival * *best) return std::nullopt;
  }
  return u - (first + (best - score.begin()));
}

}  // namespace mvo
