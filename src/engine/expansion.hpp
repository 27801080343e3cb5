// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One move of alpha-expansion: any set of tracklets may switch to the label alpha, and the best set
// is a minimum cut.
#pragma once

#include <optional>
#include <vector>

#include "mvo/engine/energy.hpp"

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

/// The expansion of alpha from an assignment with the least energy; none if certainly no expansion
/// lowers the energy. Only a new label's own cost may still outweigh what is gained.
std::optional<std::vector<int>> bestExpansion(const Energy& energy,
                                              const Neighborhood& neighborhood,
                                              const std::vector<int>& assignment, int alpha);

}  // namespace mvo
