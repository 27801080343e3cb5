// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-A: the neighbourhood graph of the tracklets.
#pragma once

#include <vector>

#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Exact k-nearest neighbours under the maximum image distance over common frames, left (u, v)
/// [px]; undirected union. Tracklets that share no frame are not connected. Ties go to the lower
/// index.
Graph buildGraph(const Window& window, const GraphOptions& options);

/// Whether vertices belong together that have a neighbour in common, too.
enum class Reach { kNeighbors, kAcrossOthers };

/// The fully disjoint components of the subgraph that a set of vertices induces, largest first,
/// members sorted.
std::vector<std::vector<int>> components(const Graph& graph, const std::vector<int>& vertices,
                                         Reach reach = Reach::kNeighbors);

}  // namespace mvo
