// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/corner_peaks.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "kernels/corners.hpp"
#include "kernels/lanes.hpp"

namespace mvo {

namespace {

constexpr int kBandRows = 64;    // of the image, to a task
constexpr float kLeast = 0.01F;  // of a score: less is no texture [(grey level/px)^2]
constexpr int kReach = kCornerBlock / 2;
constexpr int kFirst = kReach + 1;  // pixel of a row or column that has a score

// Scores of one band of rows, from the top; keeps the last few rows of everything only.
class Band {
 public:
  explicit Band(const cv::Mat& image)
      : image_(image),
        gradients_(image.cols - 2),
        scores_(image.cols - 2 * kFirst),
        products_(static_cast<std::size_t>(3 * kCornerBlock * gradients_)),
        columns_(static_cast<std::size_t>(3 * gradients_)),
        score_rows_(static_cast<std::size_t>(3 * scores_)),
        marks_(static_cast<std::size_t>(scores_)) {}

  // Peaks of the rows begin .. end - 1, which have scores above and below.
  std::vector<CornerPeak> peaks(int begin, int end) {
    std::vector<CornerPeak> found;
    for (int v = begin - 1 - kReach; v < begin - 1 + kReach; ++v) multiply(v);
    for (int v = begin - 1; v <= end; ++v) {
      multiply(v + kReach);
      score(v);
      if (v > begin) collect(v - 1, found);
    }
    return found;
  }

 private:
  float* productRow(int k, int v) {
    return products_.data() + (k * kCornerBlock + v % kCornerBlock) * gradients_;
  }
  float* scoreRow(int v) { return score_rows_.data() + v % 3 * scores_; }

  void multiply(int v) {
    gradientProducts(image_.ptr(v) + 1, static_cast<std::ptrdiff_t>(image_.step), gradients_,
                     productRow(0, v), productRow(1, v), productRow(2, v));
  }
  void score(int v) {
    const float* rows[3][kCornerBlock];
    for (int k = 0; k < 3; ++k)
      for (int y = 0; y < kCornerBlock; ++y) rows[k][y] = productRow(k, v - kReach + y);
    cornerScores(rows, scores_, columns_.data(), scoreRow(v));
  }
  void collect(int v, std::vector<CornerPeak>& found) {
    const float* rows[3] = {scoreRow(v - 1) + 1, scoreRow(v) + 1, scoreRow(v + 1) + 1};
    const int width = scores_ - 2;
    markPeaks(rows, width, kLeast, marks_.data());
    const auto end = marks_.begin() + width;
    const auto marked = [](std::uint8_t mark) { return mark != 0; };
    for (auto it = std::find_if(marks_.begin(), end, marked); it != end;
         it = std::find_if(it + 1, end, marked)) {
      const auto i = it - marks_.begin();
      found.push_back(
          {static_cast<std::uint16_t>(i + kFirst + 1), static_cast<std::uint16_t>(v), rows[1][i]});
    }
  }

  const cv::Mat& image_;
  int gradients_;                // of a row
  int scores_;                   // of a row
  std::vector<float> products_;  // xx, xy and yy of the last five rows
  std::vector<float> columns_;
  std::vector<float> score_rows_;  // the last three
  std::vector<std::uint8_t> marks_;
};

}  // namespace

std::vector<CornerPeak> findCornerPeaks(const cv::Mat& image) {
  constexpr int margin = kFirst + 1;
  if (std::min(image.cols, image.rows) < 2 * margin + kFloats) return {};
  const int rows = image.rows - 2 * margin;
  const int bands = (rows + kBandRows - 1) / kBandRows;
  std::vector<std::vector<CornerPeak>> of_band(static_cast<std::size_t>(bands));
  cv::parallel_for_(cv::Range(0, bands), [&](const cv::Range& range) {
    Band band(image);
    for (int i = range.start; i < range.end; ++i) {
      const int begin = margin + i * kBandRows;
      of_band[static_cast<std::size_t>(i)] =
          band.peaks(begin, std::min(begin + kBandRows, margin + rows));
    }
  });
  std::vector<CornerPeak> peaks;
  for (const auto& part : of_band) peaks.insert(peaks.end(), part.begin(), part.end());
  return peaks;
}

}  // namespace mvo
