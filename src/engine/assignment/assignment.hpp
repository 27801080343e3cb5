// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-C: every tracklet is assigned to a label, by one of two solvers of the same energy.
#pragma once

#include <vector>

#include "engine/energy.hpp"
#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Alpha-expansion with label costs (PEARL style) on Boost.Graph's max-flow. Starts from
/// `assignment` (entries 0 .. L) and never raises the energy. Deterministic.
std::vector<int> expandLabels(const Energy& energy, std::vector<int> assignment);

/// The convex relaxation (CORAL): primal-dual with the simplex constraint and the max-type label
/// cost, rounded to labels. Returns the rounded solution or `assignment`, whichever has the lower
/// energy. Deterministic.
std::vector<int> relaxLabels(const Energy& energy, std::vector<int> assignment,
                             const CoralOptions& options);

/// The labels with the assignment that the solver finds from theirs.
Labeling assignLabels(const Energy& energy, Labeling labels, Solver solver,
                      const CoralOptions& coral);

}  // namespace mvo
