// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/motion_color.hpp"

#include <cstddef>

namespace mvo {

namespace {

using Color = std::array<std::uint8_t, 3>;

constexpr Color kStaticColor = {175, 175, 175};
constexpr Color kOutlierColor = {235, 40, 40};

// Bright and far from each other and from the outliers' red.
constexpr std::array<Color, 10> kMotionColors = {{{0, 200, 255},
                                                  {255, 165, 0},
                                                  {120, 235, 60},
                                                  {255, 90, 240},
                                                  {255, 240, 0},
                                                  {90, 120, 255},
                                                  {170, 255, 200},
                                                  {190, 120, 255},
                                                  {255, 200, 140},
                                                  {0, 190, 190}}};

}  // namespace

std::array<std::uint8_t, 3> motionColor(LabelId id) {
  if (id == kStatic) return kStaticColor;
  if (id < kStatic) return kOutlierColor;
  return kMotionColors[static_cast<std::size_t>(id - 1) % kMotionColors.size()];
}

}  // namespace mvo
