// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/assignment/minimum_cut.hpp"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/property_map/property_map.hpp>
#include <cassert>
#include <cstddef>
#include <utility>

namespace mvo {

void MinimumCut::add(int from, int to, double capacity, double reverse_capacity) {
  assert(capacity >= 0 && reverse_capacity >= 0);
  arcs_.push_back({from, to, capacity, reverse_capacity});
}

std::vector<char> MinimumCut::solve() const {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property,
                                                   boost::no_property, boost::no_property, int>;
  using ArcId = boost::graph_traits<Graph>::edge_descriptor;

  const std::size_t n = static_cast<std::size_t>(vertices_);
  std::vector<int> next(n + 1, 0);  // where the next arc of a vertex goes
  for (const Arc& a : arcs_) {
    ++next[a.from + 1];
    ++next[a.to + 1];
  }
  for (std::size_t v = 0; v < n; ++v) next[v + 1] += next[v];

  const std::size_t m = 2 * arcs_.size();
  std::vector<std::pair<int, int>> ends(m);
  std::vector<double> capacity(m);
  std::vector<double> residual(m);
  std::vector<ArcId> reverse(m);
  for (const Arc& a : arcs_) {
    const int forth = next[a.from]++;
    const int back = next[a.to]++;
    ends[forth] = {a.from, a.to};
    ends[back] = {a.to, a.from};
    capacity[forth] = a.capacity;
    capacity[back] = a.reverse_capacity;
    reverse[forth] = ArcId(a.to, back);
    reverse[back] = ArcId(a.from, forth);
  }

  Graph graph(boost::edges_are_sorted, ends.begin(), ends.end(), n);
  const auto vertex_index = boost::get(boost::vertex_index, graph);
  const auto arc_index = boost::get(boost::edge_index, graph);
  std::vector<ArcId> predecessor(n);
  std::vector<boost::default_color_type> color(n);
  std::vector<int> distance(n);
  boost::boykov_kolmogorov_max_flow(
      graph, boost::make_iterator_property_map(capacity.begin(), arc_index),
      boost::make_iterator_property_map(residual.begin(), arc_index),
      boost::make_iterator_property_map(reverse.begin(), arc_index),
      boost::make_iterator_property_map(predecessor.begin(), vertex_index),
      boost::make_iterator_property_map(color.begin(), vertex_index),
      boost::make_iterator_property_map(distance.begin(), vertex_index), vertex_index,
      static_cast<std::size_t>(kSource), static_cast<std::size_t>(kSink));

  std::vector<char> on_source_side(n);
  for (std::size_t v = 0; v < n; ++v) on_source_side[v] = color[v] == boost::black_color;
  return on_source_side;
}

}  // namespace mvo
