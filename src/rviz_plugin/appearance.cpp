// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/appearance.hpp"

#include "edges/motion_color.hpp"

namespace mvo_rviz {

namespace {

bool isPale(const mvo::Motion& motion) {
  return motion.state == mvo::Motion::STOPPED || motion.state == mvo::Motion::OCCLUDED;
}

const char* nameOf(std::uint8_t state) {
  switch (state) {
    case mvo::Motion::NEW:
      return "new";
    case mvo::Motion::TRACKED:
      return "tracked";
    case mvo::Motion::STOPPED:
      return "stopped";
    case mvo::Motion::LOST:
      return "lost";
    case mvo::Motion::OCCLUDED:
      return "occluded";
    default:
      return "unknown";
  }
}

}  // namespace

bool isVisible(const mvo::Motion& motion) { return motion.state != mvo::Motion::LOST; }

Rgba colorOf(const mvo::Motion& motion, float alpha) {
  constexpr float kPaleGrey = 0.7F;
  constexpr float kPaleShare = 0.5F;  // of grey in the colour
  constexpr float kPaleAlpha = 0.5F;
  const auto color = mvo::motionColor(motion.id);
  const float share = isPale(motion) ? kPaleShare : 0;
  const auto mixed = [&](std::uint8_t c) {
    return (1 - share) * static_cast<float>(c) / 255 + share * kPaleGrey;
  };
  return {mixed(color[0]), mixed(color[1]), mixed(color[2]),
          isPale(motion) ? kPaleAlpha * alpha : alpha};
}

std::string captionOf(const mvo::Motion& motion) {
  return (motion.is_static ? "camera" : std::to_string(motion.id)) + " " + nameOf(motion.state);
}

}  // namespace mvo_rviz
