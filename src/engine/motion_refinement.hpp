// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Gauss-Newton on one motion between two frames, with the pairs as arrays and everything of fixed
// size.
#pragma once

#include <vector>

#include "engine/ransac.hpp"

namespace mvo {

/// The pairs that a motion is fitted to. Cleared and filled again it allocates nothing.
class MotionFit {
 public:
  explicit MotionFit(const LinkResidual& residual);

  void clear() { pairs_ = 0; }
  void add(const StereoPair& pair);

  /// As refineMotion().
  Eigen::Isometry3d refine(Eigen::Isometry3d T_b_a, double scale, int iterations) const;

 private:
  StereoCamera camera_;
  double ratio2_;
  int pairs_ = 0;
  std::vector<double> data_;  // six values and a weight of four pairs, then of the next four
};

}  // namespace mvo
