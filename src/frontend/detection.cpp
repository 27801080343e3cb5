// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/detection.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mvo {

namespace {

constexpr double kNominalPixels = 640.0 * 480.0;  // spacing is given for this size
constexpr int kRegionCells = 4;          // a region is this many cells wide, for an even spread
constexpr double kDenseFactor = 0.5;     // spacing on moving bodies, relative
constexpr float kDenseContrast = 0.25F;  // least eigenvalue there, relative
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

}  // namespace

double spacingIn(const cv::Size& size, const FrontendOptions& options) {
  return options.spacing * std::sqrt(size.area() / kNominalPixels);
}

std::vector<cv::Point2f> detectCorners(const std::vector<CornerPeak>& peaks, const cv::Size& size,
                                       const std::vector<Feature>& known,
                                       const TrackingPrior& prior, const FrontendOptions& options) {
  const int room = options.max_features - static_cast<int>(known.size());
  if (room <= 0) return {};
  const double spacing = spacingIn(size, options);
  const int border = options.patch / 2 + 2;
  const auto least = static_cast<float>(options.min_contrast * options.min_contrast);

  cv::Mat dense(size, CV_8U, cv::Scalar(0));
  for (const Feature& f : known)
    if (prior.dense.count(f.id) != 0)
      cv::circle(dense, cv::Point(cvRound(f.y.x()), cvRound(f.y.y())),
                 cvRound(kDenseReach * spacing), cv::Scalar(255), cv::FILLED);
  Occupancy occupied(size);
  const auto radius = [&dense, spacing](const cv::Point& p) {
    return spacing * (dense.at<uchar>(p) != 0 ? kDenseFactor : 1.0);
  };
  const cv::Rect frame(0, 0, size.width, size.height);
  const int region = std::max(1, cvRound(kRegionCells * spacing));
  const int regions_across = size.width / region + 1;
  std::vector<int> crowd(static_cast<std::size_t>(regions_across) * (size.height / region + 1), 0);
  const auto region_of = [region, regions_across](const cv::Point& p) {
    return p.y / region * regions_across + p.x / region;
  };
  for (const Feature& f : known) {
    const cv::Point p(cvRound(f.y.x()), cvRound(f.y.y()));
    if (!frame.contains(p)) continue;
    occupied.add(p, radius(p));
    ++crowd[region_of(p)];
  }

  std::vector<Corner> corners;
  const cv::Rect inner(border, border, size.width - 2 * border, size.height - 2 * border);
  for (const CornerPeak& peak : peaks) {
    const cv::Point p(peak.u, peak.v);
    if (inner.contains(p) &&
        peak.score > (dense.at<uchar>(p) != 0 ? kDenseContrast : 1.0F) * least && occupied.free(p))
      corners.push_back({p, peak.score, region_of(p)});
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.score != b.score ? a.score > b.score
                              : std::make_pair(a.p.y, a.p.x) < std::make_pair(b.p.y, b.p.x);
  });

  // Best first within a region; regions take turns by how many points they have.
  std::vector<std::pair<int, cv::Point2f>> ranked;
  for (const Corner& c : corners) {
    if (!occupied.free(c.p)) continue;
    occupied.add(c.p, radius(c.p));
    const int turn = crowd[c.region]++;
    ranked.emplace_back(dense.at<uchar>(c.p) != 0 ? 0 : turn,
                        c.p);  // with the first of each region
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<cv::Point2f> points;
  for (const auto& [turn, p] : ranked)
    if (static_cast<int>(points.size()) < room) points.push_back(p);
  return points;
}

}  // namespace mvo
