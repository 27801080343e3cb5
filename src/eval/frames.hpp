// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimates and truth on one clock: everything is scored by the index of the true frame.
#pragma once

#include <vector>

#include "io/frame_clock.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

/// Labels by frame; those that belong to no frame are left out.
std::vector<std::vector<LabelRow>> labelsByFrame(const FrameClock& clock,
                                                 const std::vector<LabelRow>& labels);

/// Length of the line through the positions [m].
double pathLength(const FramePoses& poses);

}  // namespace mvo
