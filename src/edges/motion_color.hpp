// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One colour per motion, the same in images, clouds and rviz.
#pragma once

#include <array>
#include <cstdint>

#include "mvo/types.hpp"

namespace mvo {

/// Red, green and blue of a motion: grey for the static world, red for outliers, else one of ten
/// that depends on the id alone.
std::array<std::uint8_t, 3> motionColor(LabelId id);

}  // namespace mvo
