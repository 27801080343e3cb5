// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Eq. (2): the energy that label assignment (III-C) and merging (III-D) lower.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace mvo {

/// A labelling problem of N tracklets and L labels; label L, the last column, is the outlier label.
struct Energy {
  struct Edge {
    int p = 0;
    int q = 0;
    double weight = 0;  ///< lambda * omega_pq
  };

  Eigen::MatrixXd data;        ///< rho(p, l), N x (L + 1); kInadmissible where l cannot hold p
  std::vector<Edge> edges;     ///< Potts
  Eigen::VectorXd label_cost;  ///< gamma_l, L + 1 entries, the outlier label's is 0

  static constexpr double kInadmissible = 1e6;  ///< finite, so that sums and flows stay finite

  int tracklets() const { return static_cast<int>(data.rows()); }
  int outlier() const { return static_cast<int>(data.cols()) - 1; }
  /// E of an assignment with entries in 0 .. L.
  double evaluate(const std::vector<int>& assignment) const;
};

}  // namespace mvo
