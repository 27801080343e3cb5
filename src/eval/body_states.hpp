// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which bodies count in a frame: those that can be seen and clearly move are required, those that
// are gone or at rest must not be found, everything between may be.
#pragma once

#include <vector>

#include "eval/frames.hpp"
#include "mvo/evaluation.hpp"

namespace mvo {

enum class View { kGone, kPartly, kVisible };
enum class Movement { kRest, kUnclear, kMoving };
enum class Role { kForbidden, kEither, kRequired };

/// What a body does in a frame.
struct BodyState {
  View view = View::kGone;
  Movement movement = Movement::kUnclear;

  /// Visible and moving: required; gone or at rest: forbidden; else either.
  Role role() const;
};

/// Visible: at least 1 % of the image covered and 60 % of the body in view; gone: less than 0.1 %
/// of the image.
View viewOf(const BodyVisibility& visibility);

/// Whether the body moves, per frame. Moving: within the last 48 frames (this one included) it was
/// ever more than 20 mm or 1 degree away from its present pose; at rest: never more than a tenth of
/// that; a frame without a true pose is unclear. In the first 47 frames a body at rest that moves
/// later within frames 0..47 is unclear as well, as a batch may know.
std::vector<Movement> movements(const FramePoses& truth);

/// Both, per frame; visibility has one entry per frame.
std::vector<BodyState> bodyStates(const FramePoses& truth,
                                  const std::vector<BodyVisibility>& visibility);

/// The stretches in view, in order.
std::vector<Stretch> stretchesInView(const std::vector<BodyState>& states);

}  // namespace mvo
