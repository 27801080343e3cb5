// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Has the body in a hand-drawn box its own label? For real sequences without masks.
#pragma once

#include <vector>

#include "eval/frames.hpp"
#include "mvo/evaluation.hpp"

namespace mvo {

/// True if one id >= 1 holds most of at least ten tracklets inside the box and has at most 20 % of
/// its own tracklets outside of it.
bool hasOwnLabel(const std::vector<LabelRow>& labels, const TrueBox& box);

BoxScore scoreBoxes(const FrameClock& clock, const std::vector<std::vector<LabelRow>>& labels,
                    const std::vector<TrueBox>& boxes);

}  // namespace mvo
