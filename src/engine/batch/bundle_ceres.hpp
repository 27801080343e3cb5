// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F's reference back end: Ceres with the landmarks eliminated (Schur).
#pragma once

#include "engine/batch/bundle_problem.hpp"

namespace mvo {

/// Minimises J from problem.start. One thread: Ceres' sums over several depend on their timing.
BundleSolution solveBundleWithCeres(const BundleProblem& problem,
                                    const BundleAdjustmentOptions& options, int iterations);

}  // namespace mvo
