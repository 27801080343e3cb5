// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A minimum cut of a sparse graph, by Boost.Graph's Boykov-Kolmogorov maximum flow.
#pragma once

#include <vector>

namespace mvo {

/// Collects arcs and finds the cut between the vertices kSource and kSink.
class MinimumCut {
 public:
  static constexpr int kSource = 0;
  static constexpr int kSink = 1;

  /// Of a graph with the vertices 0 .. vertices - 1, terminals included.
  explicit MinimumCut(int vertices) : vertices_(vertices) {}

  /// Capacities are finite and not negative; no pair of vertices is added twice.
  void add(int from, int to, double capacity, double reverse_capacity = 0);

  /// Whether each vertex is on the source's side; of all minimum cuts the one with the fewest
  /// vertices there.
  std::vector<char> solve() const;

 private:
  struct Arc {
    int from;
    int to;
    double capacity;
    double reverse_capacity;
  };
  int vertices_;
  std::vector<Arc> arcs_;
};

}  // namespace mvo
