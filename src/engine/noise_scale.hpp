// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Thresholds follow the noise of the images.
#pragma once

#include "mvo/options.hpp"

namespace mvo {

/// What "fits" means depends on how well points can be followed in these images: thresholds and
/// costs, given for clean ones, grow with the residuals [px] that labelled tracklets showed in the
/// last window (0: unknown), unless energy.adaptive is off.
Options scaledToNoise(Options options, double typical_residual);

}  // namespace mvo
