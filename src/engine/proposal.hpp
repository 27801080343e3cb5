// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-B: labels proposed by the disjoint components of the labels' supports, and labels carried on
// to a new frame.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/graph/graph.hpp"
#include "engine/residuals.hpp"
#include "kernels/link_residual.hpp"
#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A trajectory hypothesis and which of the tracklets it was made from are inliers in most of their
/// pairs.
struct Proposal {
  Trajectory trajectory;
  std::vector<int> inliers;
  std::vector<int> outliers;
};

/// Frame-to-frame RANSAC over all frame pairs that the tracklets span.
Proposal proposeTrajectory(const Window& window, const std::vector<int>& tracklets,
                           const LinkResidual& residual, const ProposalOptions& options,
                           std::uint64_t seed);

/// Proposes labels round after round; remembers what it has tried, so that no component is tried
/// twice in the same window.
class Proposer {
 public:
  /// With options.warm_start, a component that its label explains keeps that label: in a
  /// cold start from the second round on, in a `warm` one at once, and there components that are no
  /// longer seen are left alone too. Without, every component proposes anew in every round, as the
  /// paper does.
  /// A label explains the tracklets that it leaves a residual below `threshold` [px].
  Proposer(const Window& window, const Graph& graph, const LinkResidual& residual,
           const ProposalOptions& options, double threshold, std::uint64_t seed, bool warm);

  /// One round: every component of a label's support, those of the outlier label last. Supports of
  /// new labels are their inliers; outlying tracklets go to the outlier label.
  Labeling propose(Labeling labels, ResidualCache& residuals);

 private:
  bool explained(const std::vector<int>& component, const Label& label,
                 ResidualCache& residuals) const;
  void proposeFrom(const std::vector<int>& component, Labeling& labels);
  void proposeFromOutliers(Reach reach, Labeling& labels);

  const Window& window_;
  const Graph& graph_;
  const LinkResidual& residual_;
  ProposalOptions options_;
  double threshold_;  // [px]
  std::uint64_t seed_;
  bool warm_;
  bool keeps_;  // labels of components that they explain
  std::set<std::vector<int>> tried_;
  int proposals_ = 0;
};

/// Carries each label's trajectory on to the window's newest frame by the motion of its own
/// tracklets; a pair of frames with fewer than `min_observations` of them has none.
Labeling extendLabels(const Window& window, const LinkResidual& residual, Labeling labels,
                      const ProposalOptions& options, int min_observations, std::uint64_t seed);

}  // namespace mvo
