// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/segment_motions.hpp"

#include <algorithm>
#include <map>

#include "engine/assignment/assignment.hpp"
#include "engine/estimation.hpp"
#include "engine/graph/graph.hpp"
#include "engine/merging.hpp"
#include "engine/proposal.hpp"
#include "engine/residuals.hpp"
#include "engine/sanitization.hpp"
#include "stopwatch.hpp"

namespace mvo {

namespace {

constexpr double kMaxScale = 4.0;       // of the thresholds
constexpr int kRefiningIterations = 3;  // of a proposal

// The grouping without the labels' names: every tracklet is given the first member of its group.
std::vector<int> partition(const Labeling& labels) {
  std::vector<int> first(labels.labels.size(), -1);
  std::vector<int> groups(labels.assignment.size(), kOutlier);
  for (std::size_t p = 0; p < groups.size(); ++p) {
    const int l = labels.assignment[p];
    if (l == kOutlier) continue;
    if (first[l] < 0) first[l] = static_cast<int>(p);
    groups[p] = first[l];
  }
  return groups;
}

Labeling assignLabels(const Energy& energy, Labeling labels, const Options& options) {
  std::vector<int> assignment = std::move(labels.assignment);
  for (int& l : assignment)
    if (l == kOutlier) l = energy.outlier();
  assignment = options.engine.solver == Solver::kCoral
                   ? relaxLabels(energy, std::move(assignment), options.coral)
                   : expandLabels(energy, std::move(assignment));
  for (int& l : assignment)
    if (l == energy.outlier()) l = kOutlier;
  labels.assignment = std::move(assignment);
  return labels;
}

std::vector<std::vector<int>> supportsOf(const Labeling& labels) {
  std::vector<std::vector<int>> supports;
  for (std::size_t l = 0; l < labels.labels.size(); ++l)
    supports.push_back(labels.support(static_cast<int>(l)));
  return supports;
}

// Proposals of this round are chains of frame-to-frame motions; a few batch steps on their own
// tracklets take the noise of the chain out before Eq. (2) sees them.
Labeling refineProposals(const Window& window, const StereoCamera& camera, Labeling labels,
                         std::size_t known, const Options& options,
                         std::map<int, LandmarkMap>& refined) {
  const auto first = static_cast<std::ptrdiff_t>(known);
  const auto supports = supportsOf(labels);
  const std::vector<Label> proposals(labels.labels.begin() + first, labels.labels.end());
  auto estimates = estimateLabels(
      window, camera, proposals, {supports.begin() + first, supports.end()},
      std::vector<BatchStart>(proposals.size(), {nullptr, kRefiningIterations, false}), options);
  for (std::size_t i = 0; i < proposals.size(); ++i)
    if (estimates[i]) {
      labels.labels[known + i].trajectory = estimates[i]->trajectory;  // no residual was taken yet
      refined[proposals[i].serial] = std::move(estimates[i]->landmarks);
    }
  return labels;
}

// Labels of the last window start from its landmarks, new ones from their refinement. Serial
// numbers of the former are their places in the warm start; proposals count from beyond.
std::vector<BatchStart> batchStarts(const std::vector<Label>& labels, const WarmStart& start,
                                    const std::map<int, LandmarkMap>& refined,
                                    const BundleAdjustmentOptions& options) {
  std::vector<BatchStart> starts;
  for (const Label& label : labels) {
    const auto serial = static_cast<std::size_t>(label.serial);
    const auto own = refined.find(label.serial);
    if (serial < start.landmarks.size() && !start.landmarks[serial].p_c.empty())
      starts.push_back({&start.landmarks[serial], options.warm_iterations});
    else
      starts.push_back({own != refined.end() ? &own->second : nullptr, options.max_iterations});
  }
  return starts;
}

// A batch that was allowed no iteration has its start's poses, with their covariance.
bool isUntouched(const std::optional<LabelEstimate>& estimate) {
  return estimate && estimate->summary.iterations == 0 && !estimate->summary.converged;
}

// What "fits" means depends on how well points can be followed in these images: thresholds and
// costs, given for clean ones, grow with the residuals that the dominant motion's own tracklets
// show.
Options scaledToNoise(Options options, double typical_residual) {
  if (!options.energy.adaptive) return options;
  const double scale =
      std::clamp(typical_residual / options.energy.typical_residual, 1.0, kMaxScale);
  for (double* px :
       {&options.proposal.threshold, &options.energy.dead_zone, &options.energy.threshold,
        &options.energy.smoothness, &options.energy.label_cost, &options.energy.outlier_scale,
        &options.energy.outlier_decay})
    *px *= scale;
  return options;
}

// Of the dominant motion's tracklets.
double dominantResidual(const Labeling& labels, ResidualCache& residuals) {
  int largest = -1;
  std::vector<int> support;
  for (int l = 0; l < static_cast<int>(labels.labels.size()); ++l)
    if (std::vector<int> s = labels.support(l); s.size() > support.size()) {
      largest = l;
      support = std::move(s);
    }
  if (largest < 0) return 0;
  return typicalResidual(support, residuals.overlap(labels.labels[largest]));
}

}  // namespace

Segmentation segmentMotions(const Window& window, const StereoCamera& camera, WarmStart start,
                            const Options& nominal, const Deadline& deadline) {
  Segmentation result;
  Stopwatch watch;
  const Options options = scaledToNoise(nominal, start.typical_residual);
  const bool warm = options.proposal.warm_start && !start.labels.empty();
  Labeling labels{start.labels, std::move(start.assignment)};
  labels.assignment.resize(window.tracklets.size(), kOutlier);
  for (std::size_t l = 0; l < labels.labels.size(); ++l)
    labels.labels[l].serial = static_cast<int>(l);
  labels = extendLabels(window, camera, std::move(labels), options);

  const Graph graph = buildGraph(window, options.graph);  // III-A
  watch.lap("graph");
  ResidualCache residuals(window, camera, options.noise, options.energy);
  std::map<int, LandmarkMap> refined;  // of proposals, by serial number
  Proposer proposer(window, graph, camera, options, warm);
  for (result.rounds = 1; result.rounds <= options.engine.max_rounds; ++result.rounds) {
    const std::vector<int> before = partition(labels);
    const std::size_t known = labels.labels.size();
    labels = proposer.propose(std::move(labels), residuals);  // III-B
    if (options.proposal.refine && labels.labels.size() > known) {
      if (deadline.passed())
        result.cut_short.refinement = true;
      else
        labels = refineProposals(window, camera, std::move(labels), known, options, refined);
    }
    watch.lap("propose");
    const ResidualTable table = residuals.table(labels.labels);
    const Energy energy = makeEnergy(table, graph, options.energy);  // Eq. (2)
    watch.lap("residuals");
    labels = assignLabels(energy, std::move(labels), options);  // III-C
    watch.lap("assign");
    labels = dropEmptyLabels(mergeLabels(window, graph, table, std::move(labels), options.energy,
                                         MergeScope::kAdjacent));  // III-D
    watch.lap("merge");
    result.converged = partition(labels) == before;
    if (result.converged) break;
    result.cut_short.rounds = result.rounds < options.engine.max_rounds && deadline.passed();
    if (result.cut_short.rounds) break;
  }
  result.rounds = std::min(result.rounds, options.engine.max_rounds);
  result.typical_residual = dominantResidual(labels, residuals);
  const int warm_labels = warm ? static_cast<int>(start.labels.size()) : 0;
  result.labeling =
      sanitizeLabels(window, graph, residuals, std::move(labels), options, warm_labels);  // III-E
  watch.lap("sanitize");
  auto starts = batchStarts(result.labeling.labels, start, refined, options.bundle_adjustment);
  if (deadline.passed())
    for (BatchStart& s : starts) s.iterations = 0;
  result.estimates = estimateLabels(window, camera, result.labeling.labels,
                                    supportsOf(result.labeling), starts, options);  // III-F
  result.cut_short.batch =
      std::any_of(result.estimates.begin(), result.estimates.end(), isUntouched);
  result.converged = result.converged && !result.cut_short.any();
  watch.lap("batch");
  result.timings_ms = watch.laps();
  return result;
}

Segmentation sequentialRansac(const Window& window, const StereoCamera& camera,
                              const Options& options) {
  Segmentation result;
  Stopwatch watch;
  Labeling& labels = result.labeling;
  labels.assignment.assign(window.tracklets.size(), kOutlier);
  std::vector<int> left(window.tracklets.size());
  for (std::size_t p = 0; p < left.size(); ++p) left[p] = static_cast<int>(p);
  while (static_cast<int>(left.size()) >= options.engine.min_tracklets) {
    ++result.rounds;
    Proposal proposal =
        proposeTrajectory(window, left, camera, options, options.seed + result.rounds);
    if (static_cast<int>(proposal.inliers.size()) < options.engine.min_tracklets) break;
    for (const int p : proposal.inliers)
      labels.assignment[p] = static_cast<int>(labels.labels.size());
    labels.labels.push_back({kOutlier, std::move(proposal.trajectory)});
    left = std::move(proposal.outliers);
  }
  result.converged = true;
  watch.lap("propose");
  result.estimates =
      estimateLabels(window, camera, labels.labels, supportsOf(labels),
                     batchStarts(labels.labels, {}, {}, options.bundle_adjustment), options);
  watch.lap("batch");
  result.timings_ms = watch.laps();
  return result;
}

}  // namespace mvo
