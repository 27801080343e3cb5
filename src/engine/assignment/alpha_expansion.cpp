// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-C by alpha-expansion with label costs, as in PEARL (Delong et al., "Fast approximate energy
// minimization with label costs"), and by exchanging whole labels where expansions are stuck.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/assignment/assignment.hpp"
#include "engine/assignment/expansion.hpp"

namespace mvo {

namespace {

constexpr double kLeastGain = 1e-9;  // of an accepted move

// An assignment and its energy.
struct Solution {
  std::vector<int> assignment;
  double value;
};

// The better of a solution and its best expansion of alpha.
Solution expand(const Energy& energy, Expansions& expansions, Solution solution, int alpha) {
  auto expanded = expansions.best(solution.assignment, alpha);
  if (!expanded) return solution;
  const double value = energy.evaluate(*expanded);
  if (value >= solution.value - kLeastGain) return solution;
  return {std::move(*expanded), value};
}

// Expands every label in turn until none of them lowers the energy.
Solution descend(const Energy& energy, Expansions& expansions, Solution solution) {
  const int labels = energy.outlier() + 1;
  int idle = 0;  // labels in a row without a gain
  for (int alpha = 0; idle < labels; alpha = (alpha + 1) % labels) {
    const double before = solution.value;
    solution = expand(energy, expansions, std::move(solution), alpha);
    idle = solution.value < before ? 0 : idle + 1;
  }
  return solution;
}

// What emptying a label gives its tracklets: the best of the outlier label and the others in use.
struct Emptied {
  std::vector<int> tracklets;
  std::vector<int> fallback;  // parallel: a label
  double least;               // gained, without smoothness and substitutes
  double ties;                // the edges that the label's tracklets have with others
};

// Expansions only ever give to one label, so they rarely empty one or exchange it for another; this
// tries each. The tracklets of the emptied label take the best of the other labels in use, the
// outlier label and a substitute, a label not in use or the outlier label, which then expands.
class Exchange {
 public:
  Exchange(const Energy& energy, Expansions& expansions, const Solution& solution)
      : energy_(energy),
        expansions_(expansions),
        solution_(solution),
        used_(energy.data.cols(), 0),
        spared_(Eigen::MatrixXd::Zero(energy.data.cols(), energy.data.cols())) {
    for (const int l : solution.assignment) used_[l] = 1;
    for (int s = 0; s <= energy.outlier(); ++s) {
      if (!substitutes(s)) continue;
      for (int p = 0; p < energy.tracklets(); ++p) {
        const int l = solution.assignment[p];
        spared_(l, s) += std::max(0.0, energy.data(p, l) - energy.data(p, s));
      }
    }
  }

  // The first solution that is better, or none.
  std::optional<Solution> first() {
    for (int label = 0; label < energy_.outlier(); ++label) {
      if (!used_[label]) continue;
      const Emptied emptied = empty(label);
      for (int substitute = energy_.outlier(); substitute >= 0; --substitute) {
        if (!substitutes(substitute) || mostGain(emptied, label, substitute) <= kLeastGain)
          continue;
        Solution candidate = replace(emptied, substitute);
        if (candidate.value < solution_.value - kLeastGain) return candidate;
      }
    }
    return std::nullopt;
  }

 private:
  bool substitutes(int label) const { return !used_[label] || label == energy_.outlier(); }

  Emptied empty(int label) const {
    Emptied emptied{{}, {}, energy_.label_cost[label], 0};
    const std::vector<int>& f = solution_.assignment;
    for (int p = 0; p < energy_.tracklets(); ++p) {
      if (f[p] != label) continue;
      int best = energy_.outlier();
      for (int l = 0; l < energy_.outlier(); ++l)
        if (used_[l] && l != label && energy_.data(p, l) < energy_.data(p, best)) best = l;
      emptied.tracklets.push_back(p);
      emptied.fallback.push_back(best);
      emptied.least += energy_.data(p, label) - energy_.data(p, best);
      for (const auto& q : expansions_.neighborhood().of(p))
        if (f[q.tracklet] != label) emptied.ties += q.weight;
    }
    return emptied;
  }

  // As long as the other tracklets stay or take the substitute.
  double mostGain(const Emptied& emptied, int label, int substitute) const {
    double most = emptied.least + emptied.ties;
    for (int l = 0; l <= energy_.outlier(); ++l)
      if (l != label) most += spared_(l, substitute);
    if (substitute == energy_.outlier()) return most;
    for (std::size_t i = 0; i < emptied.tracklets.size(); ++i) {
      const int p = emptied.tracklets[i];
      most += std::max(0.0, energy_.data(p, emptied.fallback[i]) - energy_.data(p, substitute));
    }
    return most - energy_.label_cost[substitute];
  }

  Solution replace(const Emptied& emptied, int substitute) {
    std::vector<int> g = solution_.assignment;
    for (std::size_t i = 0; i < emptied.tracklets.size(); ++i) {
      const int p = emptied.tracklets[i];
      const int fallback = emptied.fallback[i];
      const double excess = energy_.data(p, substitute) - energy_.data(p, fallback);
      const bool first = substitute < fallback && fallback != energy_.outlier();  // of equals
      g[p] = excess < 0 || (excess == 0 && first) ? substitute : fallback;
    }
    const double value = energy_.evaluate(g);
    Solution solution = expand(energy_, expansions_, {std::move(g), value}, substitute);
    return expand(energy_, expansions_, std::move(solution), energy_.outlier());
  }

  const Energy& energy_;
  Expansions& expansions_;
  const Solution& solution_;
  std::vector<char> used_;
  // Per label and substitute: what the label's tracklets would spare in data costs if each that
  // gains by it took the substitute.
  Eigen::MatrixXd spared_;
};

}  // namespace

std::vector<int> expandLabels(const Energy& energy, std::vector<int> assignment) {
  Expansions expansions(energy);
  const double value = energy.evaluate(assignment);
  Solution solution = descend(energy, expansions, {std::move(assignment), value});
  while (auto better = Exchange(energy, expansions, solution).first())
    solution = descend(energy, expansions, std::move(*better));
  return solution.assignment;
}

}  // namespace mvo
