// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/feature_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "frontend/circle_matching.hpp"
#include "frontend/detection.hpp"
#include "frontend/klt.hpp"
#include "frontend/stereo_match.hpp"

namespace mvo {

namespace {

constexpr int kAlignSteps = 6;
constexpr float kMinCorrelation = 0.8F;
constexpr float kMaxCorrection = 1.0F;  // of the frame-to-frame link [px]

}  // namespace

// Those not seen in the newest frame first, then every so many of its own, old and new alike; those
// on moving bodies last.
void FeatureTracker::forgetSurplus(const TrackingPrior& prior, int max_features) {
  const bool is_surplus = max_features < wanted_;
  wanted_ = max_features;
  if (!is_surplus || waiting_.empty()) return;
  for (std::size_t i = 0; i + 1 < waiting_.size(); ++i) waiting_[i].clear();
  std::vector<Feature>& all = waiting_.back();
  const auto wanted = static_cast<std::size_t>(max_features);
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

std::vector<Feature> FeatureTracker::track(FrameImages images, const TrackingPrior& prior,
                                           const StereoCamera& camera,
                                           const FrontendOptions& options) {
  forgetSurplus(prior, options.max_features);
  std::vector<Feature> features = found(images, prior, camera, options);
  std::vector<Feature> fresh = detect(images, features, prior, camera, options);
  features.insert(features.end(), fresh.begin(), fresh.end());
  std::sort(features.begin(), features.end(),
            [](const Feature& a, const Feature& b) { return a.id < b.id; });

  if (options.tracker == Tracker::kKlt) alignWithReferences(images, prior, options.patch, features);

  past_.push_back(std::move(images));
  waiting_.push_back(features);
  if (static_cast<int>(past_.size()) > 1 + max_gap_) {
    past_.erase(past_.begin());
    waiting_.erase(waiting_.begin());
  }
  return features;
}

// Newest frames first: a point is looked for in the frame where it was last seen.
std::vector<Feature> FeatureTracker::found(const FrameImages& images, const TrackingPrior& prior,
                                           const StereoCamera& camera,
                                           const FrontendOptions& options) {
  std::vector<Feature> all;
  for (auto i = static_cast<std::ptrdiff_t>(past_.size()) - 1; i >= 0; --i) {
    std::vector<Feature>& waiting = waiting_[i];
    const auto& link = options.tracker == Tracker::kDescriptor ? matchAroundCircle : closeCircle;
    const std::vector<Feature> links = link(past_[i], images, waiting, prior, camera, options);
    const auto seen = [&links](const Feature& f) {
      return std::binary_search(links.begin(), links.end(), f,
                                [](const Feature& a, const Feature& b) { return a.id < b.id; });
    };
    waiting.erase(std::remove_if(waiting.begin(), waiting.end(), seen), waiting.end());
    const auto may_go_on = [&images](const Feature& f) {
      return isAllowed(images.mask, {cvRound(f.y.x()), cvRound(f.y.y())});
    };
    std::copy_if(links.begin(), links.end(), std::back_inserter(all), may_go_on);
  }
  return all;
}

FeatureTracker::Alignment FeatureTracker::aligned(const FrameImages& images, const Feature& feature,
                                                  int patch_side) const {
  const Eigen::Vector2f left = feature.y.head<2>().cast<float>();
  const Eigen::Vector2f right(static_cast<float>(feature.y.z()),
                              static_cast<float>(feature.v_right));
  const auto align = [](const ReferencePatch& patch, const std::vector<cv::Mat>& pyramid,
                        const Eigen::Vector2f& p, PatchWarp& warp) {
    const auto found = patch.align(pyramid.front(), {warp.A, p}, kAlignSteps);
    if (!found || found->correlation <= kMinCorrelation ||
        (found->warp.t - p).norm() >= kMaxCorrection)
      return false;
    warp = found->warp;
    return true;
  };
  if (const Appearance* known = appearanceOf(feature.id)) {
    Appearance a = *known;
    if (align(*a.patch, images.left, left, a.left) &&
        (images.right.empty() || align(*a.patch, images.right, right, a.right)))
      return {a};
  }
  // The look is new, or has changed too much: from here on it is this one.
  const auto patch = ReferencePatch::take(images.left.front(), left, patch_side);
  if (!patch) return {};
  Appearance a{feature.id,
               std::make_shared<ReferencePatch>(*patch),
               {Eigen::Matrix2f::Identity(), left},
               {Eigen::Matrix2f::Identity(), right}};
  const bool matches = images.right.empty() || align(*a.patch, images.right, right, a.right);
  return {a, matches};
}

const FeatureTracker::Appearance* FeatureTracker::appearanceOf(TrackletId id) const {
  const auto it =
      std::lower_bound(appearances_.begin(), appearances_.end(), id,
                       [](const Appearance& a, TrackletId wanted) { return a.id < wanted; });
  return it != appearances_.end() && it->id == id ? &*it : nullptr;
}

void FeatureTracker::alignWithReferences(const FrameImages& images, const TrackingPrior& prior,
                                         int patch_side, std::vector<Feature>& features) {
  std::vector<Alignment> found(features.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(features.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      found[i] = aligned(images, features[i], patch_side);
  });
  std::vector<Appearance> now;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (!found[i].matches) continue;
    Feature& feature = features[kept++] = features[i];
    if (!found[i].appearance) continue;
    const Appearance& a = *found[i].appearance;
    Eigen::Vector3d& y = feature.y;
    y.z() = images.right.empty() ? y.z() + a.left.t.x() - y.x() : a.right.t.x();
    y.head<2>() = a.left.t.cast<double>();
    feature.v_right = prior.errors ? a.right.t.y() : y.y();
    now.push_back(a);
  }
  features.resize(kept);
  for (const auto& waiting : waiting_)
    for (const Feature& f : waiting)
      if (const Appearance* a = appearanceOf(f.id)) now.push_back(*a);
  std::sort(now.begin(), now.end(),
            [](const Appearance& a, const Appearance& b) { return a.id < b.id; });
  appearances_ = std::move(now);
}

std::vector<Feature> FeatureTracker::detect(const FrameImages& images,
                                            const std::vector<Feature>& known,
                                            const TrackingPrior& prior, const StereoCamera& camera,
                                            const FrontendOptions& options) {
  std::vector<Feature> fresh;
  const std::vector<cv::Point2f> corners =
      detectCorners(images.peaks, images.left.front().size(), known, prior, options);
  const auto& match = options.tracker == Tracker::kDescriptor ? matchNewKeypoints : matchNewPoints;
  for (Feature& feature : match(images, corners, prior, camera, options)) {
    feature.id = next_id_++;
    fresh.push_back(feature);
  }
  return fresh;
}

}  // namespace mvo
