// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/segmenter.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/noise_scale.hpp"
#include "engine/proposal.hpp"
#include "kernels/link_residual.hpp"

namespace mvo {

namespace {

constexpr std::size_t kLeastLength = 3;  // a tracklet of two observations is nothing but its link

// Residual [px] of a tracklet's newest link under the label that suits it best; infinite if no
// label has a motion there.
double newestResidual(const Tracklet& tracklet, const std::vector<Label>& labels,
                      const LinkResidual& residual) {
  const Observation& b = tracklet.observations.back();
  const Observation& a = *(&b - 1);
  double best = std::numeric_limits<double>::infinity();
  for (const Label& label : labels)
    if (const auto T_b_a = label.trajectory.between(b.frame, a.frame))
      best = std::min(best, residual(*T_b_a, a.y, b.y));
  return best;
}

}  // namespace

std::vector<int> Segmenter::assignment(const Window& window) const {
  std::vector<int> labels;
  labels.reserve(window.tracklets.size());
  for (const Tracklet& t : window.tracklets) {
    const auto it = label_of_.find(t.id);
    labels.push_back(it == label_of_.end() ? kOutlier : it->second);
  }
  return labels;
}

std::vector<TrackletId> Segmenter::extend(const Window& window, const StereoCamera& camera,
                                          const Options& nominal) {
  const Options options = scaledToNoise(nominal, typical_residual_);
  const LinkResidual residual(camera, options.noise, options.energy.residual);
  Labeling extended;
  extended.assignment = assignment(window);
  for (KnownLabel& label : labels_)
    extended.labels.push_back({label.id, std::move(label.trajectory)});
  extended = extendLabels(window, residual, std::move(extended), options.proposal,
                          options.bundle_adjustment.min_observations, options.seed);
  std::vector<TrackletId> broken;
  for (std::size_t p = 0; p < window.tracklets.size(); ++p) {
    const Tracklet& t = window.tracklets[p];
    if (extended.assignment[p] == kOutlier || t.last() != window.last_frame ||
        t.observations.size() < kLeastLength)
      continue;
    const double best = newestResidual(t, extended.labels, residual);
    if (std::isfinite(best) && best > options.energy.threshold) broken.push_back(t.id);
  }
  for (std::size_t l = 0; l < labels_.size(); ++l)
    labels_[l].trajectory = std::move(extended.labels[l].trajectory);
  return broken;
}

Segmentation Segmenter::segment(const Window& window, const StereoCamera& camera,
                                const Options& options, const Deadline& deadline) const {
  if (options.engine.engine == Engine::kSequentialRansac)
    return sequentialRansac(window, camera, options);
  return segmentMotions(window, camera, {labels_, assignment(window), typical_residual_, memory_},
                        options, deadline);
}

void Segmenter::remember(const Window& window, Segmentation segmentation) {
  Labeling& labeling = segmentation.labeling;
  typical_residual_ = segmentation.typical_residual;
  labels_.clear();
  for (std::size_t l = 0; l < labeling.labels.size(); ++l) {
    Label& label = labeling.labels[l];
    auto& estimate = segmentation.estimates[l];
    if (estimate)
      labels_.push_back(
          {label.id, std::move(estimate->trajectory), std::move(estimate->landmarks)});
    else
      labels_.push_back({label.id, std::move(label.trajectory), {}});
  }
  label_of_.clear();
  for (std::size_t p = 0; p < labeling.assignment.size(); ++p)
    if (labeling.assignment[p] != kOutlier)
      label_of_.set(window.tracklets[p].id, labeling.assignment[p]);
}

}  // namespace mvo
