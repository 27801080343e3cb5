// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/noise_scale.hpp"

#include <algorithm>

namespace mvo {

namespace {

constexpr double kMaxScale = 4.0;  // images worse than that have no motions to be told apart

}  // namespace

Options scaledToNoise(Options options, double typical_residual) {
  if (!options.energy.adaptive) return options;
  const double scale =
      std::clamp(typical_residual / options.energy.typical_residual, 1.0, kMaxScale);
  for (double* px :
       {&options.proposal.threshold, &options.energy.dead_zone, &options.energy.threshold,
        &options.energy.smoothness, &options.energy.label_cost, &options.energy.outlier_scale,
        &options.energy.outlier_decay})
    *px *= scale;
  return options;
}

}  // namespace mvo
