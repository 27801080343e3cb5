// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/assignment/assignment.hpp"

#include <utility>

namespace mvo {

Labeling assignLabels(const Energy& energy, Labeling labels, Solver solver,
                      const CoralOptions& coral) {
  std::vector<int> assignment = std::move(labels.assignment);
  for (int& l : assignment)
    if (l == kOutlier) l = energy.outlier();
  assignment = solver == Solver::kCoral ? relaxLabels(energy, std::move(assignment), coral)
                                        : expandLabels(energy, std::move(assignment));
  for (int& l : assignment)
    if (l == energy.outlier()) l = kOutlier;
  labels.assignment = std::move(assignment);
  return labels;
}

}  // namespace mvo
