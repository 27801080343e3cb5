// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/rivals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "kernels/patch.hpp"

namespace mvo {

namespace {

constexpr int kSide = 7;        // of the patch at half resolution: what a tracker's covers [px]
constexpr int kLeastReach = 4;  // rows are as long as the kernel's lanes [px]
constexpr int kHalf = kSide / 2;
constexpr int kArea = kSide * kSide;
constexpr float kLeastVariance = 0.5F;     // [grey levels^2]
constexpr float kLeastCorrelation = 0.8F;  // from which on a patch passes for another one
constexpr std::size_t kMost = 8;           // the nearest tell the period

// Correlations at half resolution with all patches around one.
class SimilarityMap {
 public:
  SimilarityMap(const cv::Mat& image, const cv::Point& centre, int reach)
      : centre_(centre),
        u0_(std::max(kHalf, centre.x - reach)),
        v0_(std::max(kHalf, centre.y - reach)),
        columns_(std::min(image.cols - 1 - kHalf, centre.x + reach) - u0_ + 1),
        rows_(std::min(image.rows - 1 - kHalf, centre.y + reach) - v0_ + 1) {
    std::array<float, kArea> patch;
    if (columns_ <= 0 || rows_ <= 0 || centre.x < kHalf || centre.y < kHalf ||
        centre.x + kHalf >= image.cols || centre.y + kHalf >= image.rows || !take(image, patch))
      return;
    values_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (int row = 0; row < rows_; ++row)
      rowCorrelations(image.ptr(v0_ + row - kHalf) + u0_ - kHalf,
                      static_cast<std::ptrdiff_t>(image.step), kSide, patch.data(), columns_,
                      values_.data() + static_cast<std::ptrdiff_t>(row) * columns_);
  }

  // Places of the peaks above `least` besides the centre's, relative to it [px].
  std::vector<cv::Point> peaks(float least) const {
    std::vector<cv::Point> found;
    if (values_.empty()) return found;
    for (int row = 1; row + 1 < rows_; ++row)
      for (int column = 1; column + 1 < columns_; ++column) {
        if (!(at(row, column) > least)) continue;
        const cv::Point d(u0_ + column - centre_.x, v0_ + row - centre_.y);
        if (std::max(std::abs(d.x), std::abs(d.y)) > 1 && isPeak(row, column)) found.push_back(d);
      }
    return found;
  }

 private:
  bool take(const cv::Mat& image, std::array<float, kArea>& patch) const {
    for (int i = 0; i < kArea; ++i) {
      const int row = i / kSide;
      patch[i] = image.ptr(centre_.y - kHalf + row)[centre_.x - kHalf + i % kSide];
    }
    const float mean = std::accumulate(patch.begin(), patch.end(), 0.0F) / kArea;
    float square = 0;
    for (float& value : patch) {
      value -= mean;
      square += value * value;
    }
    if (square < kLeastVariance * kArea) return false;
    for (float& value : patch) value /= std::sqrt(square);
    return true;
  }
  float at(int row, int column) const {
    return values_[static_cast<std::size_t>(row) * columns_ + column];
  }
  bool isPeak(int row, int column) const {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        if (at(row + dv, column + du) > at(row, column)) return false;
    return true;
  }

  cv::Point centre_;
  int u0_;
  int v0_;
  int columns_;
  int rows_;
  std::vector<float> values_;
};

}  // namespace

std::vector<Eigen::Vector2f> findRivals(const std::vector<cv::Mat>& pyramid, const cv::Point2f& p,
                                        double reach) {
  const std::size_t level = pyramid.size() > 1 ? 1 : 0;
  const float scale = level == 1 ? 2.0F : 1.0F;
  const cv::Point centre(cvRound(p.x / scale), cvRound(p.y / scale));
  // One pixel more, for a peak needs neighbours.
  const double pixels = std::min(reach, kFarthestRival) / scale + 1;
  const SimilarityMap map(pyramid[level], centre,
                          std::max(kLeastReach, static_cast<int>(std::ceil(pixels))));
  std::vector<Eigen::Vector2f> rivals;
  for (const cv::Point& d : map.peaks(kLeastCorrelation))
    rivals.push_back(scale * Eigen::Vector2f(static_cast<float>(d.x), static_cast<float>(d.y)));
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  if (rivals.size() > kMost) rivals.resize(kMost);
  return rivals;
}

}  // namespace mvo
