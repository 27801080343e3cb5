// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/frontend/detection.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mvo {

namespace {

constexpr int kBlock = 5;                         // neighbourhood of the gradient matrix [px]
constexpr double kNominalPixels = 640.0 * 480.0;  // spacing is given for this size
constexpr int kRegionCells = 4;          // a region is this many cells wide, for an even spread
constexpr double kDenseFactor = 0.5;     // spacing on moving bodies, relative
constexpr float kDenseContrast = 0.25F;  // least eigenvalue there, relative
constexpr double kDenseReach = 2.0;      // around a point of a moving body [spacings]

// OpenCV scales Sobel's derivatives (8 x the gradient) by 1 / (4 * block * 255) and sums over
// block^2 pixels.
constexpr double kContrastOfEigenvalue = 4.0 * 255.0 / 8.0;

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

std::vector<cv::Point2f> detectCorners(const cv::Mat& image, const std::vector<Feature>& known,
                                       const TrackingPrior& prior, const FrontendOptions& options) {
  const int room = options.max_features - static_cast<int>(known.size());
  if (room <= 0) return {};
  const double spacing = spacingIn(image.size(), options);
  const int border = options.patch / 2 + 2;

  cv::Mat eigenvalue;
  cv::cornerMinEigenVal(image, eigenvalue, kBlock, 3);
  cv::Mat peak;
  cv::dilate(eigenvalue, peak, cv::Mat());
  const auto least = static_cast<float>(std::pow(options.min_contrast / kContrastOfEigenvalue, 2));

  cv::Mat dense(image.size(), CV_8U, cv::Scalar(0));
  for (const Feature& f : known)
    if (prior.dense.count(f.id) != 0)
      cv::circle(dense, cv::Point(cvRound(f.y.x()), cvRound(f.y.y())),
                 cvRound(kDenseReach * spacing), cv::Scalar(255), cv::FILLED);
  Occupancy occupied(image.size());
  const auto radius = [&dense, spacing](const cv::Point& p) {
    return spacing * (dense.at<uchar>(p) != 0 ? kDenseFactor : 1.0);
  };
  const cv::Rect frame(0, 0, image.cols, image.rows);
  const int region = std::max(1, cvRound(kRegionCells * spacing));
  const int regions_across = image.cols / region + 1;
  std::vector<int> crowd(static_cast<std::size_t>(regions_across) * (image.rows / region + 1), 0);
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
  for (int v = border; v < image.rows - border; ++v) {
    const auto* e = eigenvalue.ptr<float>(v);
    const auto* m = peak.ptr<float>(v);
    for (int u = border; u < image.cols - border; ++u)
      if (e[u] > (dense.at<uchar>(v, u) != 0 ? kDenseContrast : 1.0F) * least && e[u] == m[u] &&
          occupied.free({u, v}))
        corners.push_back(
            {cv::Point2f(static_cast<float>(u), static_cast<float>(v)), e[u], region_of({u, v})});
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
