// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One move of alpha-expansion: any set of tracklets may switch to the label alpha, and the best set
// is a minimum cut.
#pragma once

#include <optional>
#include <vector>

#include "engine/energy.hpp"

namespace mvo {

/// The edges of an energy that can cost something, from both ends.
class Neighborhood {
 public:
  struct Neighbor {
    int tracklet;
    double weight;
  };
  struct Range {
    const Neighbor* first;
    const Neighbor* last;
    const Neighbor* begin() const { return first; }
    const Neighbor* end() const { return last; }
  };

  explicit Neighborhood(const Energy& energy);
  Range of(int p) const { return {neighbors_.data() + row_[p], neighbors_.data() + row_[p + 1]}; }

 private:
  std::vector<int> row_;
  std::vector<Neighbor> neighbors_;
};

/// Finds best expansions. Remembers the last assignment: only where the next one differs is
/// anything but the bounds computed anew.
class Expansions {
 public:
  /// The energy must outlive this.
  explicit Expansions(const Energy& energy);

  /// The expansion of alpha from an assignment with the least energy; none if certainly no
  /// expansion lowers the energy. Only a new label's own cost may still outweigh what is gained.
  std::optional<std::vector<int>> best(const std::vector<int>& assignment, int alpha);

  const Neighborhood& neighborhood() const { return neighborhood_; }

 private:
  enum State : char { kFree, kKeeps, kSwitches };

  void moveTo(const std::vector<int>& assignment);
  double share(int p, const Neighborhood::Neighbor& q) const;
  void screen(int alpha);
  void openFree(int alpha);
  void decide(int p, State state);
  void close(int label);
  void decideByBounds();
  bool closeLabels();
  double mostGain(int alpha);
  void cut();

  const Energy& energy_;
  Neighborhood neighborhood_;

  // Of the assignment.
  std::vector<int> f_;
  std::vector<int> support_;    // per label: how many
  std::vector<double> cost_;    // rho(p, f(p))
  std::vector<double> border_;  // half the weight of the edges to other labels
  std::vector<double>
      most_;  // the gain of a switch if all neighbours switch, but for rho(p, alpha)

  // Of a move.
  std::vector<State> state_;
  std::vector<int> free_;  // those that the bounds of one tracklet alone leave undecided, sorted
  std::vector<char> leavable_;  // per label: may everybody switch?
  std::vector<double> gain_;
  std::vector<double> shares_;               // sum over the free neighbours
  std::vector<int> undecided_;               // whose bounds have changed
  std::vector<int> vertex_;                  // in the cut
  std::vector<double> refund_, all_, some_;  // per label
  double settled_ = 0;  // gain of those that have been decided, free neighbours keeping
};

}  // namespace mvo
