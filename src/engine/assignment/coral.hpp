// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-C by convex relaxation (CORAL): tracklets hold shares of labels instead of one label,
//   min over u_p in the simplex of  sum_p <rho_p, u_p>  +  sum_pq w_pq |u_p - u_q|_1 / 2
//                                   +  sum_l gamma_l max_p u_p(l),
// which is Eq. (2) wherever u is integral, so its minimum is a lower bound.
#pragma once

#include <vector>

#include "engine/energy.hpp"
#include "mvo/options.hpp"

namespace mvo {

/// What the relaxation knows about the minimum of an energy:
/// lower_bound <= minimum <= energy, and lower_bound <= minimum of the relaxation <= objective.
struct Relaxation {
  std::vector<int> assignment;  ///< the best rounded one, or the start
  double energy = 0;            ///< of the assignment
  double objective = 0;         ///< of the relaxation at the last iterate
  double lower_bound = 0;       ///< by duality
  int iterations = 0;
};

/// Primal-dual iteration (Chambolle and Pock, diagonally preconditioned) until the lower bound is
/// within options.tolerance, relative, of either the objective or the energy.
Relaxation solveRelaxation(const Energy& energy, std::vector<int> start,
                           const CoralOptions& options);

}  // namespace mvo
