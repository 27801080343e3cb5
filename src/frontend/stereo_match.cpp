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

// A patch without mean and of unit length; false if it shows nothing.
bool takePatch(const cv::Mat& image, int u, int v, int side, float* patch) {
  const int half = side / 2;
  const int n = side * side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) patch[y * side + x] = image.ptr(v - half + y)[u - half + x];
  const float mean = std::accumulate(patch, patch + n, 0.0F) / static_cast<float>(n);
  float square = 0;
  for (int i = 0; i < n; ++i) {
    patch[i] -= mean;
    square += patch[i] * patch[i];
  }
  if (square < kLeastVariance * static_cast<float>(n)) return false;
  for (int i = 0; i < n; ++i) patch[i] /= std::sqrt(square);
  return true;
}

}  // namespace

std::optional<EpipolarMatch> searchEpipolarLine(const cv::Mat& left, const cv::Mat& right,
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
  std::array<float, kMaxSide * kMaxSide> patch;
  if (!takePatch(left, u, v, search.patch, patch.data())) return std::nullopt;

  const int n = last - first + 1;
  std::vector<float> score(static_cast<std::size_t>(n), -1.0F);  // of the best row
  std::vector<int> down(score.size(), 0);
  std::vector<float> of_row(score.size());
  const int highest = std::max(search.first_down, half - v);
  const int lowest = std::min(search.last_down, right.rows - 1 - half - v);
  for (int dv = highest; dv <= lowest; ++dv) {
    rowCorrelations(right.ptr(v + dv - half) + first - half,
                    static_cast<std::ptrdiff_t>(right.step), search.patch, patch.data(), n,
                    of_row.data());
    for (std::size_t i = 0; i < score.size(); ++i)
      if (of_row[i] > score[i]) {
        score[i] = of_row[i];
        down[i] = dv;
      }
  }
  const auto best = std::max_element(score.begin(), score.end());
  if (!(*best >= search.min_correlation)) return std::nullopt;
  for (auto s = score.begin(); s != score.end(); ++s) {
    const bool peak = (s == score.begin() || *s >= s[-1]) && (s + 1 == score.end() || *s >= s[1]);
    if (peak && std::abs(s - best) > 2 && *s > search.max_rival * *best) return std::nullopt;
  }
  return EpipolarMatch{static_cast<double>(u - (first + (best - score.begin()))),
                       down[best - score.begin()]};
}

}  // namespace mvo
