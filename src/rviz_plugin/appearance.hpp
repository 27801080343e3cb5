// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What of a motion's look follows from its message alone: whether, in which colour, under what
// name.
#pragma once

#include <mvo/Motion.h>

#include <string>

namespace mvo_rviz {

/// Red, green, blue and opacity, each from 0 to 1.
struct Rgba {
  float r = 1;
  float g = 1;
  float b = 1;
  float a = 1;
};

/// Lost motions vanish.
bool isVisible(const mvo::Motion& motion);

/// The library's colour of the id; paler if the body rests or is out of sight.
Rgba colorOf(const mvo::Motion& motion, float alpha);

/// "camera" or the id, and the state, such as "3 tracked".
std::string captionOf(const mvo::Motion& motion);

}  // namespace mvo_rviz
