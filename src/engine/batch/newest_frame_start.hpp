// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a warm start's batch does not know yet, estimated against what it does: the newest pose
// against known landmarks, then new landmarks against the poses.
#pragma once

#include "engine/batch/bundle_problem.hpp"

namespace mvo {

/// Improves problem.start where landmarks are known (BatchTrack::is_known). The newest pose is a
/// guess from one frame to the next, many standard deviations off: under a narrow robust loss the
/// batch's first step would hardly listen to its measurements. Never raises J; leaves a start
/// without known landmarks alone.
void startNewestFrame(BundleProblem& problem);

}  // namespace mvo
