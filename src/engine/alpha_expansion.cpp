// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-C by alpha-expansion with label costs, as in PEARL (Delong et al., "Fast approximate energy
// minimization with label costs"), and by exchanging whole labels where expansions are stuck.
#include <algorithm>
#include <optional>
#include <utility>

#include "engine/expansion.hpp"
#include "mvo/engine/assignment.hpp"

namespace mvo {

namespace {

constexpr double kLeastGain = 1e-9;  // of an accepted move

// An assignment and its energy.
struct Solution {
  std::vector<int> assignment;
  double value;
};

// The better of a solution and its best expansion of alpha.
Solution expand(const Energy& energy, const Neighborhood& neighborhood, Solution solution,
                int alpha) {
  auto expanded = bestExpansion(energy, neighborhood, solution.assignment, alpha);
  if (!expanded) return solution;
  const double value = energy.evaluate(*expanded);
  if (value >= solution.value - kLeastGain) return solution;
  return {std::move(*expanded), value};
}

// Expands every label in turn until none of them lowers the energy.
Solution descend(const Energy& energy, const Neighborhood& neighborhood, Solution solution) {
  const int labels = energy.outlier() + 1;
  int idle = 0;  // labels in a row without a gain
  for (int alpha = 0; idle < labels; alpha = (alpha + 1) % labels) {
    const double before = solution.value;
    solution = expand(energy, neighborhood, std::move(solution), alpha);
    idle = solution.value < before ? 0 : idle + 1;
  }
  return solution;
}

// Empties a label: its tracklets take the best of the other labels in use, the outlier label and
// `substitute`, a label not in use or the outlier label, which then expand. None if that cannot pay
// as long as the other tracklets stay or take the substitute.
std::optional<Solution> replaceLabel(const Energy& energy, const Neighborhood& neighborhood,
                                     const std::vector<int>& f, std::vector<char> used, int label,
                                     int substitute) {
  used[label] = 0;
  used[substitute] = 1;
  std::vector<int> g = f;
  double most = energy.label_cost[label];  // of the gain
  if (substitute != energy.outlier()) most -= energy.label_cost[substitute];
  for (int p = 0; p < energy.tracklets(); ++p) {
    if (f[p] != label) {
      most += std::max(0.0, energy.data(p, f[p]) - energy.data(p, substitute));
      continue;
    }
    int best = energy.outlier();
    for (int l = 0; l < energy.outlier(); ++l)
      if (used[l] && energy.data(p, l) < energy.data(p, best)) best = l;
    g[p] = best;
    most += energy.data(p, label) - energy.data(p, best);
    for (const auto& q : neighborhood.of(p))
      if (f[q.tracklet] != label) most += q.weight;
  }
  if (most <= kLeastGain) return std::nullopt;
  const double value = energy.evaluate(g);
  Solution solution = expand(energy, neighborhood, {std::move(g), value}, substitute);
  return expand(energy, neighborhood, std::move(solution), energy.outlier());
}

// Expansions only ever give to one label, so they rarely empty one or exchange it for another; this
// tries each. Returns the first solution that is better, or none.
std::optional<Solution> exchange(const Energy& energy, const Neighborhood& neighborhood,
                                 const Solution& solution) {
  std::vector<char> used(energy.data.cols(), 0);
  for (int l : solution.assignment) used[l] = 1;
  for (int label = 0; label < energy.outlier(); ++label) {
    if (!used[label]) continue;
    for (int substitute = energy.outlier(); substitute >= 0; --substitute) {
      if (used[substitute] && substitute != energy.outlier()) continue;
      auto candidate =
          replaceLabel(energy, neighborhood, solution.assignment, used, label, substitute);
      if (candidate && candidate->value < solution.value - kLeastGain) return candidate;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<int> expandLabels(const Energy& energy, std::vector<int> assignment) {
  const Neighborhood neighborhood(energy);
  const double value = energy.evaluate(assignment);
  Solution solution = descend(energy, neighborhood, {std::move(assignment), value});
  while (auto better = exchange(energy, neighborhood, solution))
    solution = descend(energy, neighborhood, std::move(*better));
  return solution.assignment;
}

}  // namespace mvo
