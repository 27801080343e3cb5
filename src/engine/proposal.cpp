// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/proposal.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "engine/ransac.hpp"

namespace mvo {

namespace {

// Proposals and extensions draw from streams of their own, which these numbers keep apart.
constexpr std::uint64_t kFirstProposal = 1 << 20;
constexpr std::uint64_t kExtension = 1000;

// One generator per (seed, frame, label): the order of work does not matter.
std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  std::uint64_t h = a * 0x9E3779B97F4A7C15ULL + b + 0x7F4A7C159E3779B9ULL;
  h ^= h >> 30;
  h *= 0xBF58476D1CE4E5B9ULL;
  return h ^ (h >> 27);
}

struct PairSet {
  std::vector<StereoPair> pairs;
  std::vector<int> owner;  // tracklet of each
};

// The pairs of consecutive frames that the tracklets are seen in, by their second frame, from
// `first` to `last`.
std::vector<PairSet> pairsInto(const Window& window, const std::vector<int>& tracklets,
                               FrameId first, FrameId last) {
  std::vector<PairSet> sets(last - first + 1);
  for (const int p : tracklets) {
    const auto& o = window.tracklets[p].observations;
    for (std::size_t j = o.size(); j-- > 1 && o[j].frame >= first;) {
      if (o[j].frame > last || o[j].frame - o[j - 1].frame != 1) continue;
      PairSet& set = sets[o[j].frame - first];
      set.pairs.push_back({o[j - 1].y, o[j].y});
      set.owner.push_back(p);
    }
  }
  return sets;
}

int seenIn(const Window& window, const std::vector<int>& tracklets, FrameId frame) {
  return static_cast<int>(std::count_if(tracklets.begin(), tracklets.end(), [&](int p) {
    return window.tracklets[p].last() == frame;
  }));
}

}  // namespace

Proposal proposeTrajectory(const Window& window, const std::vector<int>& tracklets,
                           const LinkResidual& residual, const ProposalOptions& options,
                           std::uint64_t seed) {
  FrameId first = window.last_frame;
  FrameId last = window.first_frame;
  for (const int p : tracklets) {
    first = std::min(first, window.tracklets[p].first());
    last = std::max(last, window.tracklets[p].last());
  }
  const std::vector<PairSet> sets = pairsInto(window, tracklets, first + 1, last);
  std::vector<int> seen(window.tracklets.size(), 0);
  std::vector<int> fitted(window.tracklets.size(), 0);
  Proposal proposal;
  proposal.trajectory.first_frame = first;
  proposal.trajectory.append(std::nullopt);
  std::optional<Eigen::Isometry3d> guess;  // the motion of the pair before
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto motion = ransacMotion(sets[i].pairs, residual, options,
                                     mix(seed, first + 1 + static_cast<FrameId>(i)), guess);
    guess = motion ? std::make_optional(motion->T_b_a) : std::nullopt;
    proposal.trajectory.append(guess);
    for (std::size_t k = 0; k < sets[i].owner.size(); ++k) {
      ++seen[sets[i].owner[k]];
      if (motion && motion->inlier[k] != 0) ++fitted[sets[i].owner[k]];
    }
  }
  for (const int p : tracklets)
    (2 * fitted[p] > seen[p] || (seen[p] == 0 && fitted[p] == 0) ? proposal.inliers
                                                                 : proposal.outliers)
        .push_back(p);
  return proposal;
}

Proposer::Proposer(const Window& window, const Graph& graph, const LinkResidual& residual,
                   const ProposalOptions& options, double threshold, std::uint64_t seed, bool warm)
    : window_(window),
      graph_(graph),
      residual_(residual),
      options_(options),
      threshold_(threshold),
      seed_(seed),
      warm_(warm),
      keeps_(warm) {}

bool Proposer::explained(const std::vector<int>& component, const Label& label,
                         ResidualCache& residuals) const {
  const Eigen::VectorXd& overlap = residuals.overlap(label);
  const auto fits = [&](int p) { return overlap(p) < threshold_; };
  return 2 * std::count_if(component.begin(), component.end(), fits) >
         static_cast<std::ptrdiff_t>(component.size());
}

void Proposer::proposeFrom(const std::vector<int>& component, Labeling& labels) {
  if (keeps_ && !tried_.insert(component).second) return;
  Label label;
  label.proposal = proposals_++;
  const std::uint64_t stream = kFirstProposal + static_cast<std::uint64_t>(label.proposal);
  const std::uint64_t seed = mix(mix(seed_, window_.last_frame), mix(stream, component.front()));
  Proposal proposal = proposeTrajectory(window_, component, residual_, options_, seed);
  for (const int p : proposal.outliers) labels.assignment[p] = kOutlier;
  if (static_cast<int>(proposal.inliers.size()) < options_.min_support) return;
  for (const int p : proposal.inliers)
    labels.assignment[p] = static_cast<int>(labels.labels.size());
  label.trajectory = std::move(proposal.trajectory);
  labels.labels.push_back(std::move(label));
}

void Proposer::proposeFromOutliers(Reach reach, Labeling& labels) {
  const int least = options_.min_support;
  for (const auto& component : components(graph_, labels.support(kOutlier), reach)) {
    if (static_cast<int>(component.size()) < least) continue;
    // What is no longer seen was judged while it was.
    if (warm_ && seenIn(window_, component, window_.last_frame) < least) continue;
    proposeFrom(component, labels);
  }
}

Labeling Proposer::propose(Labeling labels, ResidualCache& residuals) {
  const int known = static_cast<int>(labels.labels.size());
  const int least = options_.min_support;
  for (int l = 0; l < known; ++l)
    for (const auto& component : components(graph_, labels.support(l))) {
      if (static_cast<int>(component.size()) < least) continue;
      if (keeps_ && explained(component, labels.labels[l], residuals)) continue;
      proposeFrom(component, labels);
    }
  // Where labels have taken part of a body, its other tracklets are scattered among theirs.
  proposeFromOutliers(Reach::kNeighbors, labels);
  // Where labels have taken part of a body, its other tracklets are scattered among theirs.
  if (keeps_) proposeFromOutliers(Reach::kAcrossOthers, labels);
  keeps_ = options_.warm_start;
  return labels;
}

Labeling extendLabels(const Window& window, const LinkResidual& residual, Labeling labels,
                      const ProposalOptions& options, int min_observations, std::uint64_t seed) {
  const auto extend = [&](int l) {
    Trajectory& trajectory = labels.labels[l].trajectory;
    const FrameId next = trajectory.lastFrame() + 1;
    if (next > window.last_frame) return;
    const auto sets = pairsInto(window, labels.support(l), next, window.last_frame);
    for (const PairSet& set : sets) {
      const FrameId k = trajectory.lastFrame() + 1;
      const auto guess = trajectory.between(k - 1, k - 2);  // constant velocity
      const auto motion = static_cast<int>(set.pairs.size()) < min_observations
                              ? std::nullopt
                              : ransacMotion(set.pairs, residual, options,
                                             mix(mix(seed, k), mix(kExtension, l)), guess);
      trajectory.append(motion ? std::make_optional(motion->T_b_a) : std::nullopt);
    }
  };
  cv::parallel_for_(cv::Range(0, static_cast<int>(labels.labels.size())),
                    [&extend](const cv::Range& range) {
                      for (int l = range.start; l < range.end; ++l) extend(l);
                    });
  return labels;
}

}  // namespace mvo
