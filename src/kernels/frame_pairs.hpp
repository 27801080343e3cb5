// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pairs of two frames as arrays, and the residuals of all of them under one motion.
#pragma once

#include <vector>

#include "kernels/link.hpp"
#include "kernels/link_residual.hpp"
#include "mvo/options.hpp"

namespace mvo {

class PairArrays {
 public:
  PairArrays(const std::vector<StereoPair>& pairs, const LinkResidual& residual);

  /// The sum over all pairs of min(e^2 / threshold^2, 1), or of 1 where e >= threshold; infinity as
  /// soon as it cannot be less than `best`.
  float score(const Eigen::Isometry3d& T_b_a, Ranking ranking, float threshold, float best) const;

  /// e < threshold, one per pair.
  std::vector<char> inliers(const Eigen::Isometry3d& T_b_a, float threshold) const;

 private:
  LinkConstants<EightLinks> constants_;
  ResidualModel model_;
  int pairs_;
  std::vector<float> data_;  // six values of eight pairs, then of the next eight; NaN fills up
};

}  // namespace mvo
