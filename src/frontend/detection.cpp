// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/detection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace mvo {

namespace {

constexpr double kNominalPixels = 640.0 * 480.0;  // spacing is given for this size
constexpr int kRegionCells = 4;          // a region is this many cells wide, for an even spread
constexpr double kDenseFactor = 0.5;     // spacing on moving bodies, relative
constexpr float kDenseContrast = 0.25F;  // least eigenvalue there, relative
constexpr float kBrightScore = 160;      // of an ordinary image's strongest hundredth of peaks
constexpr float kDimmest = 0.0625F;      // of the least score that is asked for, in the dark
constexpr double kDenseReach = 2.0;      // around a point of a moving body [spacings]

struct Corner {
  cv::Point2f p;
  float score = 0;
  int region = 0;
};

// Which pixels are too close to a point that is there already.
class Occupancy {
 public:
  Occupancy(const cv::Size& size) : mask_(size, CV_8U, cv::Scalar(0)) {}
  void add(const cv::Point2f& p, double radius) {
    cv::circle(mask_, cv::Point(cvRound(p.x), cvRound(p.y)), cvRound(radius), cv::Scalar(255),
               cv::FILLED);
  }
  bool free(const cv::Point& p) const { return mask_.at<uchar>(p) == 0; }

 private:
  cv::Mat mask_;
};

// Where points are, where more are wanted, and how crowded each region is.
class Surroundings {
 public:
  Surroundings(const cv::Size& size, double spacing, const std::vector<Feature>& known,
               const TrackingPrior& prior)
      : spacing_(spacing),
        region_(std::max(1, cvRound(kRegionCells * spacing))),
        regions_across_(size.width / region_ + 1),
        dense_(size, CV_8U, cv::Scalar(0)),
        occupied_(size),
        crowd_(static_cast<std::size_t>(regions_across_) * (size.height / region_ + 1), 0) {
    for (const Feature& f : known)
      if (prior.dense.count(f.id) != 0)
        cv::circle(dense_, cv::Point(cvRound(f.y.x()), cvRound(f.y.y())),
                   cvRound(kDenseReach * spacing), cv::Scalar(255), cv::FILLED);
    for (const Feature& f : known) {
      const cv::Point p(cvRound(f.y.x()), cvRound(f.y.y()));
      if (cv::Rect({0, 0}, size).contains(p)) add(p, regionOf(p));
    }
  }

  int regionOf(const cv::Point& p) const { return p.y / region_ * regions_across_ + p.x / region_; }
  bool isDense(const cv::Point& p) const { return dense_.at<uchar>(p) != 0; }
  bool isFree(const cv::Point& p) const { return occupied_.free(p); }
  /// Takes a place; returns how many points its region had before.
  int add(const cv::Point& p, int region) {
    occupied_.add(p, spacing_ * (isDense(p) ? kDenseFactor : 1.0));
    return crowd_[region]++;
  }

 private:
  double spacing_;  // [px]
  int region_;      // side of a region [px]
  int regions_across_;
  cv::Mat dense_;
  Occupancy occupied_;
  std::vector<int> crowd_;  // points per region
};

// The least score in this light: what min_contrast says of ordinary images, and in dimmer ones less
// by as much as their strongest corners are weaker.
float leastScore(const std::vector<CornerPeak>& peaks, const FrontendOptions& options) {
  const auto least = static_cast<float>(options.min_contrast * options.min_contrast);
  const auto hundredth = static_cast<std::ptrdiff_t>(peaks.size() / 100);
  const auto is_bright = [](const CornerPeak& p) { return p.score > kBrightScore; };
  if (std::count_if(peaks.begin(), peaks.end(), is_bright) > hundredth) return least;
  std::vector<float> scores;
  scores.reserve(peaks.size());
  for (const CornerPeak& p : peaks) scores.push_back(p.score);
  if (scores.empty()) return least;
  std::nth_element(scores.begin(), scores.begin() + hundredth, scores.end(), std::greater<>());
  return std::max(scores[static_cast<std::size_t>(hundredth)] / kBrightScore, kDimmest) * least;
}

// Corners on free ground, best first.
std::vector<Corner> candidates(const std::vector<CornerPeak>& peaks, const cv::Rect& inner,
                               float least, const Surroundings& surroundings) {
  std::vector<Corner> corners;
  for (const CornerPeak& peak : peaks) {
    const cv::Point p(peak.u, peak.v);
    if (inner.contains(p) &&
        peak.score > (surroundings.isDense(p) ? kDenseContrast : 1.0F) * least &&
        surroundings.isFree(p))
      corners.push_back({p, peak.score, surroundings.regionOf(p)});
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.score != b.score ? a.score > b.score
                              : std::make_pair(a.p.y, a.p.x) < std::make_pair(b.p.y, b.p.x);
  });
  return corners;
}

}  // namespace

double spacingIn(const cv::Size& size, const FrontendOptions& options) {
  return options.spacing * std::sqrt(size.area() / kNominalPixels);
}

std::vector<cv::Point2f> detectCorners(const std::vector<CornerPeak>& peaks, const cv::Size& size,
                                       const std::vector<Feature>& known,
                                       const TrackingPrior& prior, const FrontendOptions& options) {
  const int room = options.max_features - static_cast<int>(known.size());
  if (room <= 0) return {};
  Surroundings surroundings(size, spacingIn(size, options), known, prior);
  const int border = options.patch / 2 + 2;
  const cv::Rect inner(border, border, size.width - 2 * border, size.height - 2 * border);
  const float least = leastScore(peaks, options);

  // Best first within a region; regions take turns by how many points they have, and dense
  // surroundings come with the first of each region.
  std::vector<std::pair<int, cv::Point2f>> ranked;
  for (const Corner& c : candidates(peaks, inner, least, surroundings)) {
    if (!surroundings.isFree(c.p)) continue;
    const int turn = surroundings.add(c.p, c.region);
    ranked.emplace_back(surroundings.isDense(c.p) ? 0 : turn, c.p);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<cv::Point2f> points;
  for (const auto& [turn, p] : ranked)
    if (static_cast<int>(points.size()) < room) points.push_back(p);
  return points;
}

}  // namespace mvo
