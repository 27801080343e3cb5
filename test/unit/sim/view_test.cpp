// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What an eye sees row by row, beside the scene: a hood, projected dots.
#include <gtest/gtest.h>

#include <cmath>

#include "mvo/sim.hpp"
#include "sim/dots.hpp"
#include "sim/eye.hpp"
#include "support/imperfect_blocks.hpp"

namespace mvo::sim {
namespace {

using test::blocksWith;
using test::exactFrame;
using test::identical;
using test::kFrame;
using test::later;
using test::shiftOf;

TEST(View, EveryRowIsReadAtItsTime) {
  Imperfections imperfections;
  imperfections.readout = 0.03;
  const Scene scene = blocksWith(imperfections);
  const RenderedFrame rolling = render(scene, kFrame);
  EXPECT_TRUE(rolling.T_world_camera.isApprox(exactFrame().T_world_camera, 0))
      << "the middle row's";
  EXPECT_FALSE(identical(rolling.left, exactFrame().left));
  for (const int row : {0, 100, 479}) {
    const double dt = 0.03 * (row - 239.5) / 479;
    const RenderedFrame global = render(later(blocksWith({}), dt), kFrame);
    EXPECT_LE(cv::norm(rolling.left.row(row), global.left.row(row), cv::NORM_INF), 1) << row;
    EXPECT_LE(cv::norm(rolling.right.row(row), global.right.row(row), cv::NORM_INF), 1) << row;
    EXPECT_TRUE(identical(rolling.mask.row(row), global.mask.row(row))) << row;
    EXPECT_LT(cv::norm(rolling.depth.row(row), global.depth.row(row), cv::NORM_INF), 1e-4) << row;
  }
}

TEST(View, HoodCoversItsShareAndStaysWhereItIs) {
  Imperfections imperfections;
  imperfections.hood = 0.25;
  const Scene scene = blocksWith(imperfections);
  const RenderedFrame frame = render(scene, kFrame);
  const cv::Rect above(0, 0, 640, 360);
  const cv::Rect below(0, 360, 640, 120);
  EXPECT_EQ(cv::countNonZero(frame.mask(below) != kHoodLabel), 0);
  EXPECT_EQ(cv::countNonZero(frame.mask(above) == kHoodLabel), 0);
  EXPECT_TRUE(
      identical(frame.left(cv::Rect(0, 0, 640, 359)), exactFrame().left(cv::Rect(0, 0, 640, 359))));
  const RenderedFrame next = render(scene, kFrame + 9);
  const Eigen::Vector2d shift = shiftOf(frame.left, next.left, {260, 380, 120, 80});
  EXPECT_LT(shift.norm(), 0.01) << "the camera moves, the hood with it";
  EXPECT_EQ(cv::countNonZero(next.mask(below) != kHoodLabel), 0);
}

TEST(View, DotsKeepTheirRowsAndFollowTheDepth) {
  Imperfections imperfections;
  imperfections.dots = 1500;
  const Scene scene = blocksWith(imperfections);
  const auto left = seenDots(scene, scene.time(kFrame), leftEye(scene));
  const auto right = seenDots(scene, scene.time(kFrame), rightEye(scene));
  const auto later_left = seenDots(scene, scene.time(kFrame + 9), leftEye(scene));
  const RenderedFrame frame = render(scene, kFrame);
  int both = 0;
  int at_depth = 0;
  int brighter = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (!left[i] || !right[i] || !later_left[i]) continue;
    const Eigen::Vector2d pixel = left[i]->pixel;
    const cv::Point at(static_cast<int>(std::lround(pixel.x())),
                       static_cast<int>(std::lround(pixel.y())));
    if (!cv::Rect(0, 0, 640, 480).contains(at)) continue;
    ++both;
    EXPECT_NEAR(pixel.y(), right[i]->pixel.y(), 1e-6);
    EXPECT_NEAR(pixel.y(), later_left[i]->pixel.y(), 1e-6) << "it does not move with the scene";
    const double disparity = 500 * 0.24 / frame.depth.at<float>(at);
    at_depth += std::abs(pixel.x() - right[i]->pixel.x() - disparity) < 0.3 ? 1 : 0;
    brighter += frame.left.at<std::uint8_t>(at) > exactFrame().left.at<std::uint8_t>(at) ? 1 : 0;
  }
  EXPECT_GT(both, 700);
  EXPECT_GT(at_depth, 0.97 * both);
  EXPECT_GT(brighter, 0.97 * both);
}

TEST(View, DotsOfARollingShutterHaveTheTimeOfTheirRow) {
  Imperfections imperfections;
  imperfections.dots = 300;
  const Scene global = blocksWith(imperfections);
  imperfections.readout = 0.05;
  const Scene rolling = blocksWith(imperfections);
  const auto dots = seenDots(rolling, rolling.time(kFrame), leftEye(rolling));
  int compared = 0;
  for (std::size_t i = 0; i < dots.size(); i += 7) {
    if (!dots[i]) continue;
    const double dt = 0.05 * (std::round(dots[i]->pixel.y()) - 239.5) / 479;
    const auto then = seenDots(later(global, dt), rolling.time(kFrame), leftEye(global));
    if (!then[i]) continue;
    EXPECT_NEAR((dots[i]->pixel - then[i]->pixel).norm(), 0, 1e-5);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace mvo::sim
