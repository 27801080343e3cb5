// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Gauss-Newton on one motion between two frames, with the pairs as arrays and everything of fixed
// size.
#pragma once

#include "engine/ransac.hpp"
#include "kernels/link_equations.hpp"

namespace mvo {

/// The pairs that a motion is fitted to. Cleared and filled again it allocates nothing.
class MotionFit {
 public:
  explicit MotionFit(const LinkResidual& residual) : equations_(residual) {}

  void clear() { equations_.clear(); }
  void add(const StereoPair& pair) { equations_.add(pair); }

  /// As refineMotion().
  Eigen::Isometry3d refine(Eigen::Isometry3d T_b_a, double scale, int iterations) const;

 private:
  LinkEquations equations_;
};

}  // namespace mvo
