// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/appearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "edges/motion_color.hpp"

namespace mvo_rviz {
namespace {

mvo::Motion motionOf(int id, std::uint8_t state) {
  mvo::Motion motion;
  motion.id = id;
  motion.state = state;
  motion.is_static = id == 0;
  return motion;
}

float saturation(const Rgba& c) { return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}); }

TEST(Appearance, ColoursAreTheLibrarys) {
  for (const int id : {0, 1, 2, 15}) {
    const auto expected = mvo::motionColor(id);
    const Rgba color = colorOf(motionOf(id, mvo::Motion::TRACKED), 0.75F);
    EXPECT_FLOAT_EQ(255 * color.r, expected[0]);
    EXPECT_FLOAT_EQ(255 * color.g, expected[1]);
    EXPECT_FLOAT_EQ(255 * color.b, expected[2]);
    EXPECT_FLOAT_EQ(color.a, 0.75F);
  }
}

TEST(Appearance, StoppedAndOccludedMotionsArePaler) {
  const Rgba tracked = colorOf(motionOf(2, mvo::Motion::TRACKED), 1);
  for (const std::uint8_t state : {mvo::Motion::STOPPED, mvo::Motion::OCCLUDED}) {
    const Rgba pale = colorOf(motionOf(2, state), 1);
    EXPECT_LT(saturation(pale), 0.6F * saturation(tracked));
    EXPECT_LT(pale.a, 0.6F * tracked.a);
    EXPECT_GT(pale.a, 0);
  }
}

TEST(Appearance, OnlyLostMotionsVanish) {
  for (const std::uint8_t state : {mvo::Motion::NEW, mvo::Motion::TRACKED, mvo::Motion::STOPPED,
                                   mvo::Motion::LOST, mvo::Motion::OCCLUDED})
    EXPECT_EQ(isVisible(motionOf(1, state)), state != mvo::Motion::LOST) << int{state};
}

TEST(Appearance, CaptionsSayIdAndState) {
  EXPECT_EQ(captionOf(motionOf(0, mvo::Motion::TRACKED)), "camera tracked");
  EXPECT_EQ(captionOf(motionOf(1, mvo::Motion::NEW)), "1 new");
  EXPECT_EQ(captionOf(motionOf(12, mvo::Motion::STOPPED)), "12 stopped");
  EXPECT_EQ(captionOf(motionOf(3, mvo::Motion::LOST)), "3 lost");
  EXPECT_EQ(captionOf(motionOf(4, mvo::Motion::OCCLUDED)), "4 occluded");
}

}  // namespace
}  // namespace mvo_rviz
