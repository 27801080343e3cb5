// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/segment_motions.hpp"

#include <algorithm>
#include <map>

#include "engine/assignment/assignment.hpp"
#include "engine/estimation.hpp"
#include "engine/graph/graph.hpp"
#include "engine/merging.hpp"
#include "engine/noise_scale.hpp"
#include "engine/proposal.hpp"
#include "engine/residuals.hpp"
#include "engine/sanitization.hpp"
#include "statistics.hpp"
#include "stopwatch.hpp"

namespace mvo {

namespace {

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

// The last window's labels, carried on to this window's newest frame.
Labeling knownLabels(const Window& window, const LinkResidual& residual, const WarmStart& start,
                     const Options& options) {
  Labeling labels;
  for (const KnownLabel& known : start.labels) {
    Label label{known.id, known.trajectory};
    label.known = static_cast<int>(labels.labels.size());
    labels.labels.push_back(std::move(label));
  }
  labels.assignment = start.assignment;
  labels.assignment.resize(window.tracklets.size(), kOutlier);
  return extendLabels(window, residual, std::move(labels), options.proposal,
                      options.bundle_adjustment.min_observations, options.seed);
}

// Landmarks of refined proposals, by the number of the proposal.
using Refinements = std::map<int, LandmarkMap>;

// Proposals of this round are chains of frame-to-frame motions; a few batch steps on their own
// tracklets take the noise of the chain out before Eq. (2) sees them.
Labeling refineProposals(const Window& window, const StereoCamera& camera, Labeling labels,
                         std::size_t first, const Options& options, BatchMemory& memory,
                         Refinements& refined) {
  const auto before = static_cast<int>(first);
  Labeling proposals;
  proposals.labels.assign(labels.labels.begin() + before, labels.labels.end());
  for (const int l : labels.assignment)
    proposals.assignment.push_back(l >= before ? l - before : kOutlier);
  const BatchStart start{nullptr, kRefiningIterations, false};
  auto estimates = estimateLabels(window, camera, proposals,
                                  std::vector<BatchStart>(proposals.labels.size(), start),
                                  options.noise, options.bundle_adjustment, memory);
  for (std::size_t i = 0; i < estimates.size(); ++i)
    if (estimates[i]) {
      labels.labels[first + i].trajectory = estimates[i]->trajectory;  // no residual was taken yet
      refined[proposals.labels[i].proposal] = std::move(estimates[i]->landmarks);
    }
  return labels;
}

// Labels of the last window start from its landmarks, new ones from their refinement.
std::vector<BatchStart> batchStarts(const std::vector<Label>& labels, const WarmStart& start,
                                    const Refinements& refined,
                                    const BundleAdjustmentOptions& options) {
  std::vector<BatchStart> starts;
  for (const Label& label : labels) {
    const auto own = label.known ? refined.end() : refined.find(label.proposal);
    if (label.known && !start.labels[*label.known].landmarks.p_c.empty())
      starts.push_back({&start.labels[*label.known].landmarks, options.warm_iterations});
    else
      starts.push_back({own != refined.end() ? &own->second : nullptr, options.max_iterations});
  }
  return starts;
}

// A batch that was allowed no iteration has its start's poses, with their covariance.
bool isUntouched(const std::optional<LabelEstimate>& estimate) {
  return estimate && estimate->summary.iterations == 0 && !estimate->summary.converged;
}

// Of all tracklets that have a label, each under its own: a body that fills the view for a while
// does not make its residuals those of the images.
double typicalOfAll(const Labeling& labels, ResidualCache& residuals) {
  std::vector<double> values;
  for (std::size_t p = 0; p < labels.assignment.size(); ++p)
    if (const int l = labels.assignment[p]; l != kOutlier)
      values.push_back(residuals.overlap(labels.labels[l])(static_cast<Eigen::Index>(p)));
  return values.empty() ? 0 : median(std::move(values));
}

}  // namespace

Segmentation segmentMotions(const Window& window, const StereoCamera& camera,
                            const WarmStart& start, const Options& nominal,
                            const Deadline& deadline) {
  Segmentation result;
  Stopwatch watch;
  const Options options = scaledToNoise(nominal, start.typical_residual);
  const bool warm = options.proposal.warm_start && !start.labels.empty();
  const LinkResidual residual(camera, options.noise, options.energy.residual);
  const auto memory = start.memory ? start.memory : std::make_shared<BatchMemory>();
  Labeling labels = knownLabels(window, residual, start, options);

  const Graph graph = buildGraph(window, options.graph);  // III-A
  watch.lap("graph");
  ResidualCache residuals(window, camera, options.noise, options.energy);
  Refinements refined;
  Proposer proposer(window, graph, residual, options.proposal, options.energy.threshold,
                    options.seed, warm);
  while (result.rounds < options.engine.max_rounds && !result.converged) {
    result.cut_short.rounds = result.rounds > 0 && deadline.passed();
    if (result.cut_short.rounds) break;
    ++result.rounds;
    const std::vector<int> before = partition(labels);
    const std::size_t known = labels.labels.size();
    labels = proposer.propose(std::move(labels), residuals);  // III-B
    const bool is_refined = options.proposal.refine && labels.labels.size() > known;
    if (is_refined && deadline.passed())
      result.cut_short.refinement = true;
    else if (is_refined)
      labels = refineProposals(window, camera, std::move(labels), known, options, *memory, refined);
    watch.lap("propose");
    const ResidualTable table = residuals.table(labels.labels);
    const Energy energy = makeEnergy(table, graph, options.energy);  // Eq. (2)
    watch.lap("residuals");
    labels =
        assignLabels(energy, std::move(labels), options.engine.solver, options.coral);  // III-C
    watch.lap("assign");
    labels = dropEmptyLabels(mergeLabels(window, graph, table, std::move(labels), options.energy,
                                         MergeScope::kAdjacent));  // III-D
    watch.lap("merge");
    result.converged = partition(labels) == before;
  }
  result.typical_residual = typicalOfAll(labels, residuals);
  result.labeling = sanitizeLabels(window, graph, residuals, std::move(labels), options.energy,
                                   options.engine, warm);  // III-E
  watch.lap("sanitize");
  auto starts = batchStarts(result.labeling.labels, start, refined, options.bundle_adjustment);
  if (deadline.passed())
    for (BatchStart& s : starts) s.iterations = 0;
  result.estimates = estimateLabels(window, camera, result.labeling, starts, options.noise,
                                    options.bundle_adjustment, *memory);  // III-F
  result.cut_short.batch =
      std::any_of(result.estimates.begin(), result.estimates.end(), isUntouched);
  result.converged = result.converged && !result.cut_short.any();
  watch.lap("batch");
  result.timings_ms = watch.laps();
  return result;
}

}  // namespace mvo
