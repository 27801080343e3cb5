// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>
#include <utility>

#include "engine/estimation.hpp"
#include "engine/proposal.hpp"
#include "mvo/segment_motions.hpp"
#include "stopwatch.hpp"

namespace mvo {

Segmentation sequentialRansac(const Window& window, const StereoCamera& camera,
                              const Options& options) {
  const LinkResidual residual(camera, options.noise, options.energy.residual);
  Segmentation result;
  Stopwatch watch;
  Labeling& labels = result.labeling;
  labels.assignment.assign(window.tracklets.size(), kOutlier);
  std::vector<int> left(window.tracklets.size());
  std::iota(left.begin(), left.end(), 0);
  while (static_cast<int>(left.size()) >= options.engine.min_tracklets) {
    ++result.rounds;
    Proposal proposal = proposeTrajectory(window, left, residual, options.proposal,
                                          options.seed + static_cast<std::uint64_t>(result.rounds));
    if (static_cast<int>(proposal.inliers.size()) < options.engine.min_tracklets) break;
    for (const int p : proposal.inliers)
      labels.assignment[p] = static_cast<int>(labels.labels.size());
    Label label;
    label.trajectory = std::move(proposal.trajectory);
    label.proposal = result.rounds;
    labels.labels.push_back(std::move(label));
    left = std::move(proposal.outliers);
  }
  result.converged = true;
  watch.lap("propose");
  const BatchStart cold{nullptr, options.bundle_adjustment.max_iterations};
  BatchMemory memory;
  result.estimates =
      estimateLabels(window, camera, labels, std::vector<BatchStart>(labels.labels.size(), cold),
                     options.noise, options.bundle_adjustment, memory);
  watch.lap("batch");
  result.timings_ms = watch.laps();
  return result;
}

}  // namespace mvo
