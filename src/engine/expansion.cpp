// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/expansion.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "engine/minimum_cut.hpp"

namespace mvo {

Neighborhood::Neighborhood(const Energy& energy) : row_(energy.tracklets() + 1, 0) {
  const auto costs = [](const Energy::Edge& e) { return e.p != e.q && e.weight > 0; };
  for (const auto& e : energy.edges) {
    assert(e.weight >= 0);
    if (!costs(e)) continue;
    ++row_[e.p + 1];
    ++row_[e.q + 1];
  }
  for (std::size_t p = 0; p + 1 < row_.size(); ++p) row_[p + 1] += row_[p];
  neighbors_.resize(row_.back());
  std::vector<int> next = row_;
  for (const auto& e : energy.edges) {
    if (!costs(e)) continue;
    neighbors_[next[e.p]++] = {e.q, e.weight};
    neighbors_[next[e.q]++] = {e.p, e.weight};
  }
}

namespace {

// Bounds decide most tracklets, so that only contested ones enter the cut. The gain of an
// expansion, by which the energy falls, is
//   sum over switching p of gain[p]  -  share(p, q) for each edge of which one end switches
//   +  the cost of each label that all its tracklets leave  -  the cost of alpha if it is new.
// An edge costs w unless its ends agree: within a label its share is w; between two labels one half
// of w is its share and the other half goes to the gains of both ends.
class Expansion {
 public:
  Expansion(const Energy& energy, const Neighborhood& neighborhood, const std::vector<int>& f,
            int alpha)
      : energy_(energy),
        neighborhood_(neighborhood),
        f_(f),
        alpha_(alpha),
        support_(energy.data.cols()),
        leavable_(energy.data.cols(), 0),
        state_(f.size(), kFree),
        gain_(f.size()),
        shares_(f.size(), 0.0) {
    for (int p = 0; p < energy.tracklets(); ++p) {
      support_[f[p]].push_back(p);
      leavable_[f[p]] = f[p] != alpha;
      gain_[p] = energy.data(p, f[p]) - energy.data(p, alpha);
      for (const auto& q : neighborhood.of(p)) {
        shares_[p] += share(p, q);
        if (f[p] != f[q.tracklet]) gain_[p] += 0.5 * q.weight;
      }
    }
  }

  // None if there is certainly no gain.
  std::optional<std::vector<int>> solve() {
    for (int p = 0; p < energy_.tracklets(); ++p) {
      if (f_[p] == alpha_)
        decide(p, kSwitches);
      else
        undecided_.push_back(p);
    }
    do {
      decideByBounds();
    } while (closeLabels());
    if (mostGain() <= 0) return std::nullopt;
    cut();
    std::vector<int> g = f_;
    for (int p = 0; p < energy_.tracklets(); ++p)
      if (state_[p] == kSwitches) g[p] = alpha_;
    return g;
  }

 private:
  enum State : char { kFree, kKeeps, kSwitches };

  double share(int p, const Neighborhood::Neighbor& q) const {
    return f_[p] == f_[q.tracklet] ? q.weight : 0.5 * q.weight;
  }

  // Fixes p; its shares with free neighbours go into their gains.
  void decide(int p, State state) {
    state_[p] = state;
    if (state == kSwitches) settled_ += gain_[p] - shares_[p];
    for (const auto& q : neighborhood_.of(p)) {
      if (state_[q.tracklet] != kFree) continue;
      gain_[q.tracklet] += state == kSwitches ? share(p, q) : -share(p, q);
      shares_[q.tracklet] -= share(p, q);
      undecided_.push_back(q.tracklet);
    }
    if (state == kKeeps && leavable_[f_[p]]) close(f_[p]);
  }

  // The cost of a label is paid whatever the others do.
  void close(int label) {
    leavable_[label] = 0;
    for (int p : support_[label])
      if (state_[p] == kFree) undecided_.push_back(p);
  }

  // Whoever loses by switching, whatever the others do, keeps; whoever gains, switches.
  void decideByBounds() {
    while (!undecided_.empty()) {
      const int p = undecided_.back();
      undecided_.pop_back();
      if (state_[p] != kFree) continue;
      const double refund = leavable_[f_[p]] ? energy_.label_cost[f_[p]] : 0;
      if (gain_[p] + shares_[p] + refund <= 0)
        decide(p, kKeeps);
      else if (gain_[p] - shares_[p] > 0)
        decide(p, kSwitches);
    }
  }

  // Closes the labels that lose by leaving as a whole, whatever the others do: then there is a best
  // expansion in which some of their tracklets keep. Returns whether there were any.
  bool closeLabels() {
    bool any = false;
    for (int l = 0; l <= energy_.outlier(); ++l) {
      if (!leavable_[l]) continue;
      double most = energy_.label_cost[l];
      for (int p : support_[l]) {
        if (state_[p] != kFree) continue;
        most += gain_[p];
        for (const auto& q : neighborhood_.of(p))
          if (f_[q.tracklet] != l && state_[q.tracklet] == kFree) most += share(p, q);
      }
      if (most > 0) continue;
      close(l);
      any = true;
    }
    return any;
  }

  // An upper bound: as if free edges cost nothing.
  double mostGain() const {
    double most = settled_;
    for (int l = 0; l <= energy_.outlier(); ++l) {
      double some = 0;
      double all = leavable_[l] ? energy_.label_cost[l] : 0;
      for (int p : support_[l]) {
        if (state_[p] != kFree) continue;
        some += std::max(0.0, gain_[p]);
        all += gain_[p];
      }
      most += std::max(some, all);
    }
    return support_[alpha_].empty() ? most - energy_.label_cost[alpha_] : most;
  }

  // Decides the free tracklets; those on the source's side switch. The cost of a label hangs on an
  // auxiliary vertex that is drawn to the sink's side as soon as one of the label's tracklets is.
  void cut() {
    std::vector<int> free;
    std::vector<int> vertex(f_.size(), -1);
    for (int p = 0; p < energy_.tracklets(); ++p) {
      if (state_[p] != kFree) continue;
      vertex[p] = static_cast<int>(free.size()) + 2;
      free.push_back(p);
    }
    if (free.empty()) return;
    int auxiliary = static_cast<int>(free.size()) + 2;
    MinimumCut problem(auxiliary + energy_.outlier() + 1);
    for (int p : free) {
      if (gain_[p] > 0) problem.add(MinimumCut::kSource, vertex[p], gain_[p]);
      if (gain_[p] < 0) problem.add(vertex[p], MinimumCut::kSink, -gain_[p]);
      for (const auto& q : neighborhood_.of(p))
        if (vertex[p] < vertex[q.tracklet])
          problem.add(vertex[p], vertex[q.tracklet], share(p, q), share(p, q));
    }
    for (int l = 0; l <= energy_.outlier(); ++l, ++auxiliary) {
      const double cost = energy_.label_cost[l];
      if (!leavable_[l] || cost <= 0) continue;
      problem.add(MinimumCut::kSource, auxiliary, cost);
      for (int p : support_[l])
        if (vertex[p] >= 0) problem.add(auxiliary, vertex[p], cost);
    }
    const std::vector<char> switches = problem.solve();
    for (int p : free) state_[p] = switches[vertex[p]] ? kSwitches : kKeeps;
  }

  const Energy& energy_;
  const Neighborhood& neighborhood_;
  const std::vector<int>& f_;
  int alpha_;
  std::vector<std::vector<int>> support_;  // per label
  std::vector<char> leavable_;             // per label: may everybody switch?
  std::vector<State> state_;
  std::vector<double> gain_;
  std::vector<double> shares_;  // sum over the free neighbours
  std::vector<int> undecided_;  // whose bounds have changed
  double settled_ = 0;          // gain of those that have been decided, free neighbours keeping
};

}  // namespace

std::optional<std::vector<int>> bestExpansion(const Energy& energy,
                                              const Neighborhood& neighborhood,
                                              const std::vector<int>& assignment, int alpha) {
  return Expansion(energy, neighborhood, assignment, alpha).solve();
}

}  // namespace mvo
