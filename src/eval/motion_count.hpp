// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Was the right number of motions found? (Fig. 4)
#pragma once

#include <map>
#include <set>
#include <vector>

#include "eval/body_states.hpp"
#include "eval/masked_points.hpp"

namespace mvo {

/// States of each body by its number, one entry per frame.
using BodyStates = std::map<int, std::vector<BodyState>>;

/// The ids of a frame's labels, outliers (-1) included.
using FrameIds = std::set<int>;

/// One count per frame. Without an association (no masks) exact_set stays false.
std::vector<MotionCount> countMotions(const std::vector<FrameIds>& ids, const BodyStates& states,
                                      const Association& association);

RightNumberRates rightNumberRates(const std::vector<MotionCount>& counts);

/// Frames by the number of motions found in them.
std::map<int, int> histogram(const std::vector<MotionCount>& counts);

/// Frames in which at least one tracklet has an id >= 1.
int framesWithThirdParty(const std::vector<FrameIds>& ids);

}  // namespace mvo
