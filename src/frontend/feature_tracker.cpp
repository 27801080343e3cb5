// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/frontend/feature_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "mvo/frontend/circle_matching.hpp"
#include "mvo/frontend/depth_association.hpp"
#include "mvo/frontend/detection.hpp"
#include "mvo/frontend/klt.hpp"
#include "mvo/frontend/stereo_match.hpp"

namespace mvo {

namespace {

constexpr int kAlignSteps = 6;
constexpr float kMinCorrelation = 0.8F;
constexpr float kMaxCorrection = 1.0F;  // of the frame-to-frame link [px]

}  // namespace

FrameImages prepareImages(const Frame& frame, const FrontendOptions& options) {
  if (options.tracker == Tracker::kDescriptor) return describedImages(frame, options);
  FrameImages images;
  images.left = buildPyramid(frame.left, options);
  if (!frame.right.empty()) images.right = buildPyramid(frame.right, options);
  images.depth = frame.depth;
  return images;
}

FeatureTracker::FeatureTracker(const StereoCamera& camera, const FrontendOptions& options,
                               int max_gap)
    : camera_(camera), options_(options), max_gap_(max_gap) {}

void FeatureTracker::setOptions(const FrontendOptions& options) {
  surplus_ = surplus_ || options.max_features < options_.max_features;
  options_ = options;
}

// Those not seen in the newest frame first, then every so many of its own, old and new alike; those
// on moving bodies last.
void FeatureTracker::forgetSurplus(const TrackingPrior& prior) {
  if (!surplus_ || waiting_.empty()) return;
  surplus_ = false;
  for (std::size_t i = 0; i + 1 < waiting_.size(); ++i) waiting_[i].clear();
  std::vector<Feature>& all = waiting_.back();
  const auto wanted = static_cast<std::size_t>(options_.max_features);
  for (const bool dense : {false, true}) {
    if (all.size() <= wanted) return;
    const auto is_kept = [&](const Feature& f) { return (prior.dense.count(f.id) != 0) != dense; };
    const auto kept = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_kept));
    const std::size_t thinned = all.size() - kept;
    const std::size_t left = wanted > kept ? wanted - kept : 0;
    std::size_t i = 0;
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const Feature& f) {
                               if (is_kept(f)) return false;
                               ++i;
                               return i * left / thinned == (i - 1) * left / thinned;
                             }),
              all.end());
  }
}

std::vector<Feature> FeatureTracker::track(FrameImages images, const TrackingPrior& prior) {
  forgetSurplus(prior);
  std::vector<Feature> features = found(images, prior);
  std::vector<Feature> fresh = detect(images, features, prior);
  features.insert(features.end(), fresh.begin(), fresh.end());
  std::sort(features.begin(), features.end(),
            [](const Feature& a, const Feature& b) { return a.id < b.id; });

  if (options_.tracker == Tracker::kKlt) alignWithReferences(images, features);

  past_.push_back(std::move(images));
  waiting_.push_back(features);
  if (static_cast<int>(past_.size()) > 1 + max_gap_) {
    past_.erase(past_.begin());
    waiting_.erase(waiting_.begin());
  }
  return features;
}

// Newest frames first: a point is looked for in the frame where it was last seen.
std::vector<Feature> FeatureTracker::found(const FrameImages& images, const TrackingPrior& prior) {
  std::vector<Feature> all;
  for (auto i = static_cast<std::ptrdiff_t>(past_.size()) - 1; i >= 0; --i) {
    std::vector<Feature>& waiting = waiting_[i];
    const auto& link = options_.tracker == Tracker::kDescriptor ? matchAroundCircle : closeCircle;
    const std::vector<Feature> links = link(past_[i], images, waiting, prior, camera_, options_);
    const auto seen = [&links](const Feature& f) {
      return std::binary_search(links.begin(), links.end(), f,
                                [](const Feature& a, const Feature& b) { return a.id < b.id; });
    };
    waiting.erase(std::remove_if(waiting.begin(), waiting.end(), seen), waiting.end());
    all.insert(all.end(), links.begin(), links.end());
  }
  return all;
}

void FeatureTracker::alignWithReferences(const FrameImages& images,
                                         std::vector<Feature>& features) {
  std::vector<std::optional<Appearance>> aligned(features.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(features.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      Feature& f = features[i];
      const Eigen::Vector2f left = f.y.head<2>().cast<float>();
      const Eigen::Vector2f right(static_cast<float>(f.y.z()), left.y());
      const auto close = [](const std::optional<PatchAlignment>& a, const Eigen::Vector2f& p) {
        return a && a->correlation > kMinCorrelation && (a->warp.t - p).norm() < kMaxCorrection;
      };
      const auto known = appearance_.find(f.id);
      if (known != appearance_.end()) aligned[i] = known->second;
      for (const bool fresh : {false, true}) {
        if (fresh) {  // the look has changed too much, or is new: from here on it is this one
          const auto patch = ReferencePatch::take(images.left.front(), left, options_.patch);
          aligned[i].reset();
          if (patch)
            aligned[i] = Appearance{
                *patch, {Eigen::Matrix2f::Identity(), left}, {Eigen::Matrix2f::Identity(), right}};
        }
        if (!aligned[i]) continue;
        Appearance& a = *aligned[i];
        if (!fresh) {
          const auto moved = a.patch.align(images.left.front(), {a.left.A, left}, kAlignSteps);
          if (!close(moved, left)) continue;
          a.left = moved->warp;
        }
        if (!images.right.empty()) {
          const auto seen = a.patch.align(images.right.front(), {a.right.A, right}, kAlignSteps);
          if (!close(seen, right)) continue;
          a.right = seen->warp;
        }
        f.y << a.left.t.x(), a.left.t.y(),
            (images.right.empty() ? right.x() + a.left.t.x() - left.x() : a.right.t.x());
        break;
      }
    }
  });
  std::map<TrackletId, Appearance> now;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (aligned[i]) now.emplace(features[i].id, std::move(*aligned[i]));
  for (const auto& waiting : waiting_)
    for (const Feature& f : waiting)
      if (const auto it = appearance_.find(f.id); it != appearance_.end()) now.insert(*it);
  appearance_ = std::move(now);
}

std::vector<Feature> FeatureTracker::detect(const FrameImages& images,
                                            const std::vector<Feature>& known,
                                            const TrackingPrior& prior) {
  std::vector<Feature> fresh;
  const std::vector<cv::Point2f> corners =
      detectCorners(images.left.front(), known, prior, options_);
  const auto& match = options_.tracker == Tracker::kDescriptor ? matchNewKeypoints : matchNewPoints;
  for (Feature& feature : match(images, corners, camera_, options_)) {
    feature.id = next_id_++;
    fresh.push_back(feature);
  }
  return fresh;
}

}  // namespace mvo
