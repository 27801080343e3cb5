// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Do the tracklets carry the label of what they lie on, and does a body keep its id?
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "eval/masked_points.hpp"
#include "eval/motion_count.hpp"

namespace mvo {

/// Scores by class over all observations away from mask borders. Points on bodies that do not
/// clearly move are not scored unless they carry another body's id. Ids without association count
/// as neither class.
std::map<int, ClassScore> scoreSegmentation(const MaskedFrames& frames, const BodyStates& states,
                                            const Association& association);

/// The id (>= 1) that most of the tracklets on a body carry, per frame; none with fewer than three
/// tracklets that carry one. On a tie the lower id.
std::vector<std::optional<int>> dominantIds(const MaskedFrames& frames, int body);

/// Changes of the dominant id in time, frames without one left out.
int idSwitches(const std::vector<std::optional<int>>& dominant);

/// Largest share of one and the same id (>= 1) among the observations on a body, away from borders,
/// in the frames in which it clearly moves [%].
double oneLabelPercent(const MaskedFrames& frames, int body, const std::vector<BodyState>& states);

}  // namespace mvo
