// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The normal equations of one motion between two frames, four pairs at a time.
#pragma once

#include <array>
#include <vector>

#include "kernels/link_residual.hpp"

namespace mvo {

/// The pairs of two frames as arrays. Cleared and filled again it allocates nothing.
class LinkEquations {
 public:
  static constexpr int kTriangle = 21;
  /// The lower triangle of A, row by row, and b of A step = b, step being a left perturbation of
  /// T_b_a.
  using Equations = std::array<double, kTriangle + 6>;

  explicit LinkEquations(const LinkResidual& residual);

  void clear() { pairs_ = 0; }
  void add(const StereoPair& pair);

  /// At T_b_a, always whitened, with Cauchy's weight of width `scale` [px]. Pairs behind the camera
  /// have no say.
  Equations at(const Eigen::Isometry3d& T_b_a, double scale) const;

 private:
  StereoCamera camera_;
  double ratio2_;
  int pairs_ = 0;
  std::vector<double> data_;  // six values and a weight of four pairs, then of the next four
};

}  // namespace mvo
