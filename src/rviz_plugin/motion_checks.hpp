// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Guards the display against messages that cannot be drawn, and says what is wrong with them.
#pragma once

#include <mvo/MotionArray.h>

#include <string>

namespace mvo_rviz {

/// One sentence on why nothing of the array can be drawn; empty if its motions can be.
std::string problemOf(const mvo::MotionArray& array);

/// One sentence, with id and field, on why a motion of an array in `frame_id` cannot be drawn;
/// empty if it can be: all drawn numbers are finite and not beyond kFarthest, quaternions are unit.
std::string problemOf(const mvo::Motion& motion, const std::string& frame_id);

constexpr double kFarthest = 1e7;  ///< [m], [m/s]; beyond, single precision cannot draw sensibly

}  // namespace mvo_rviz
