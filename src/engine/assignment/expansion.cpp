// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/assignment/expansion.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "engine/assignment/minimum_cut.hpp"

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

// A gain as small as this is rounding: residuals within the dead zone are equal, and so are
// weights, so that ties are common. Who is tied keeps.
constexpr double kTie = 1e-9;

}  // namespace

// Bounds decide most tracklets, so that only contested ones enter the cut. The gain of an
// expansion, by which the energy falls, is
//   sum over switching p of gain[p]  -  share(p, q) for each edge of which one end switches
//   +  the cost of each label that all its tracklets leave  -  the cost of alpha if it is new.
// An edge costs w unless its ends agree: within a label its share is w; between two labels one half
// of w is its share and the other half goes to the gains of both ends.

Expansions::Expansions(const Energy& energy)
    : energy_(energy),
      neighborhood_(energy),
      support_(energy.data.cols(), 0),
      cost_(energy.tracklets()),
      border_(energy.tracklets()),
      most_(energy.tracklets()),
      state_(energy.tracklets()),
      leavable_(energy.data.cols()),
      gain_(energy.tracklets()),
      shares_(energy.tracklets()),
      vertex_(energy.tracklets(), -1),
      refund_(energy.data.cols()),
      all_(energy.data.cols()),
      some_(energy.data.cols()) {}

std::optional<std::vector<int>> Expansions::best(const std::vector<int>& assignment, int alpha) {
  moveTo(assignment);
  screen(alpha);
  if (free_.empty()) return std::nullopt;
  openFree(alpha);
  do {
    decideByBounds();
  } while (closeLabels());
  if (mostGain(alpha) <= 0) return std::nullopt;
  cut();
  std::vector<int> g = f_;
  for (const int p : free_)
    if (state_[p] == kSwitches) g[p] = alpha;
  return g;
}

// Borders are those of what has changed and of its neighbours.
void Expansions::moveTo(const std::vector<int>& assignment) {
  const bool first = f_.empty();
  if (first) f_.assign(assignment.size(), -1);
  auto& changed = undecided_;
  changed.clear();
  for (std::size_t p = 0; p < f_.size(); ++p) {
    if (f_[p] == assignment[p]) continue;
    if (!first) --support_[f_[p]];
    ++support_[assignment[p]];
    f_[p] = assignment[p];
    changed.push_back(static_cast<int>(p));
  }
  if (!first)
    for (std::size_t i = 0, own = changed.size(); i < own; ++i)
      for (const auto& q : neighborhood_.of(changed[i])) changed.push_back(q.tracklet);
  for (const int p : changed) {
    cost_[p] = energy_.data(p, f_[p]);
    double border = 0;
    double shares = 0;
    for (const auto& q : neighborhood_.of(p)) {
      shares += share(p, q);
      if (f_[p] != f_[q.tracklet]) border += 0.5 * q.weight;
    }
    border_[p] = border;
    most_[p] = cost_[p] + border + shares;
  }
  changed.clear();
}

double Expansions::share(int p, const Neighborhood::Neighbor& q) const {
  return f_[p] == f_[q.tracklet] ? q.weight : 0.5 * q.weight;
}

// Whoever loses by switching even if all its neighbours and its whole label switch, keeps; its
// label is then paid for whatever the others do, as it is if it loses by leaving as a whole.
void Expansions::screen(int alpha) {
  const double* to_alpha = energy_.data.col(alpha).data();
  for (int l = 0; l <= energy_.outlier(); ++l) {
    leavable_[l] = l != alpha && support_[l] > 0;
    refund_[l] = energy_.label_cost[l];
    all_[l] = energy_.label_cost[l];
  }
  const int n = static_cast<int>(f_.size());
  for (int p = 0; p < n; ++p) {
    all_[f_[p]] += cost_[p] - to_alpha[p] + 2 * border_[p];
    if (most_[p] - to_alpha[p] + refund_[f_[p]] <= kTie) leavable_[f_[p]] = 0;
  }
  for (int l = 0; l <= energy_.outlier(); ++l) {
    if (all_[l] <= 0) leavable_[l] = 0;
    if (!leavable_[l]) refund_[l] = 0;
  }
  free_.clear();
  for (int p = 0; p < n; ++p) {
    state_[p] = f_[p] == alpha ? kSwitches : kKeeps;
    if (f_[p] == alpha || most_[p] - to_alpha[p] + refund_[f_[p]] <= kTie) continue;
    state_[p] = kFree;
    free_.push_back(p);
  }
}

void Expansions::openFree(int alpha) {
  settled_ = 0;
  for (const int p : free_) {
    const auto neighbors = neighborhood_.of(p);
    double gain = cost_[p] - energy_.data(p, alpha);
    double shares = 0;
    for (const auto& q : neighbors) {
      shares += share(p, q);
      if (f_[p] != f_[q.tracklet]) gain += 0.5 * q.weight;
    }
    for (const auto& q : neighbors) {
      if (state_[q.tracklet] != kSwitches) continue;
      gain += share(p, q);
      shares -= share(p, q);
    }
    for (const auto* q = neighbors.first; q != neighbors.last; ++q) {
      if (state_[q->tracklet] != kKeeps) continue;
      gain -= share(p, *q);
      shares -= share(p, *q);
    }
    gain_[p] = gain;
    shares_[p] = shares;
  }
  undecided_ = free_;
}

// Fixes p; its shares with free neighbours go into their gains.
void Expansions::decide(int p, State state) {
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
void Expansions::close(int label) {
  leavable_[label] = 0;
  for (const int p : free_)
    if (f_[p] == label && state_[p] == kFree) undecided_.push_back(p);
}

// Whoever loses by switching, whatever the others do, keeps; whoever gains, switches.
void Expansions::decideByBounds() {
  while (!undecided_.empty()) {
    const int p = undecided_.back();
    undecided_.pop_back();
    if (state_[p] != kFree) continue;
    const double refund = leavable_[f_[p]] ? energy_.label_cost[f_[p]] : 0;
    if (gain_[p] + shares_[p] + refund <= kTie)
      decide(p, kKeeps);
    else if (gain_[p] - shares_[p] > kTie)
      decide(p, kSwitches);
  }
}

// Closes the labels that lose by leaving as a whole, whatever the others do: then there is a best
// expansion in which some of their tracklets keep. Returns whether there were any.
bool Expansions::closeLabels() {
  std::fill(all_.begin(), all_.end(), 0.0);
  for (const int p : free_) {
    if (state_[p] != kFree || !leavable_[f_[p]]) continue;
    all_[f_[p]] += gain_[p];
    for (const auto& q : neighborhood_.of(p))
      if (f_[q.tracklet] != f_[p] && state_[q.tracklet] == kFree) all_[f_[p]] += share(p, q);
  }
  bool any = false;
  for (int l = 0; l <= energy_.outlier(); ++l) {
    if (!leavable_[l] || energy_.label_cost[l] + all_[l] > 0) continue;
    close(l);
    any = true;
  }
  return any;
}

// An upper bound: as if free edges cost nothing.
double Expansions::mostGain(int alpha) {
  std::fill(all_.begin(), all_.end(), 0.0);
  std::fill(some_.begin(), some_.end(), 0.0);
  for (const int p : free_) {
    if (state_[p] != kFree) continue;
    some_[f_[p]] += std::max(0.0, gain_[p]);
    all_[f_[p]] += gain_[p];
  }
  double most = settled_;
  for (int l = 0; l <= energy_.outlier(); ++l)
    most += std::max(some_[l], all_[l] + (leavable_[l] ? energy_.label_cost[l] : 0));
  return support_[alpha] == 0 ? most - energy_.label_cost[alpha] : most;
}

// Decides the free tracklets; those on the source's side switch. The cost of a label hangs on an
// auxiliary vertex that is drawn to the sink's side as soon as one of the label's tracklets is.
void Expansions::cut() {
  int vertices = 2;  // the terminals
  for (const int p : free_)
    if (state_[p] == kFree) vertex_[p] = vertices++;
  if (vertices == 2) return;
  int auxiliary = vertices;
  MinimumCut problem(vertices + energy_.outlier() + 1);
  for (const int p : free_) {
    if (vertex_[p] < 0) continue;
    if (gain_[p] > kTie) problem.add(MinimumCut::kSource, vertex_[p], gain_[p]);
    if (gain_[p] < 0) problem.add(vertex_[p], MinimumCut::kSink, -gain_[p]);
    for (const auto& q : neighborhood_.of(p))
      if (vertex_[p] < vertex_[q.tracklet])
        problem.add(vertex_[p], vertex_[q.tracklet], share(p, q), share(p, q));
  }
  for (int l = 0; l <= energy_.outlier(); ++l, ++auxiliary) {
    const double cost = energy_.label_cost[l];
    if (!leavable_[l] || cost <= 0) continue;
    problem.add(MinimumCut::kSource, auxiliary, cost);
    for (const int p : free_)
      if (f_[p] == l && vertex_[p] >= 0) problem.add(auxiliary, vertex_[p], cost);
  }
  const std::vector<char> switches = problem.solve();
  for (const int p : free_) {
    if (vertex_[p] < 0) continue;
    state_[p] = switches[vertex_[p]] ? kSwitches : kKeeps;
    vertex_[p] = -1;
  }
}

}  // namespace mvo
