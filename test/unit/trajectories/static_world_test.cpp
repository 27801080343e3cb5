// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/static_world.hpp"

#include <gtest/gtest.h>

namespace mvo {
namespace {

constexpr LabelId kBody = 4;

// A label that reaches over a share of the image and lies behind its neighbours by another.
WorldCandidate seen(int tracklets, double around, double behind) {
  WorldCandidate c;
  c.support = tracklets;
  c.evidence.seen = tracklets;
  c.evidence.around = around;
  c.evidence.behind = behind;
  c.evidence.votes = tracklets / 4;
  c.evidence.alive = true;
  return c;
}
WorldCandidate asWorld(WorldCandidate c) {
  c.was_world = c.world_before = c.support;
  return c;
}
WorldCandidate asBody(WorldCandidate c) {
  c.body = kBody;
  c.body_before = c.support;
  return c;
}

class Choice : public testing::Test {
 protected:
  std::optional<int> choose(const std::vector<WorldCandidate>& candidates) {
    return world_.choose(candidates, options_);
  }
  // Frames of the same candidates until another label than `before` is the world; `most` at most.
  int framesUntilAnother(const std::vector<WorldCandidate>& candidates, std::optional<int> before,
                         int most) {
    for (int k = 1; k <= most; ++k)
      if (choose(candidates) != before) return k;
    return most + 1;
  }
  void begin() { ASSERT_EQ(choose({seen(200, 0.9, 0.1), seen(30, 0.1, -0.3)}), 0); }

  TrajectoryOptions options_;
  StaticWorld world_;
};

TEST_F(Choice, TheFirstWorldSurroundsAndLiesBehind) {
  EXPECT_EQ(choose({seen(300, 0.6, -0.4), seen(120, 0.5, 0.5)}), 1) << "not the largest";
  EXPECT_FALSE(world_.changed());
}

TEST_F(Choice, AFarBodyInAGapIsNoWorld) {
  EXPECT_EQ(choose({seen(300, 0.95, -0.04), seen(15, 0.05, 0.8)}), 0);
}

TEST_F(Choice, SupportThatCollapsesHandsTheWorldToNoBody) {
  begin();
  const std::vector<WorldCandidate> collapsed{asBody(seen(300, 0.7, -0.3)),
                                              asWorld(seen(10, 0.1, 0.3))};
  EXPECT_EQ(framesUntilAnother(collapsed, 1, 300), 301);
  EXPECT_EQ(world_.changes(), 0);
}

TEST_F(Choice, ABodyThatFillsTwoThirdsOfTheViewDoesNotTakeOver) {
  begin();
  EXPECT_EQ(
      framesUntilAnother({asWorld(seen(90, 0.33, 0.4)), asBody(seen(250, 0.67, -0.3))}, 0, 300),
      301);
  // Nor if the depth order could not be seen.
  EXPECT_EQ(framesUntilAnother({asWorld(seen(90, 0.33, 0)), asBody(seen(250, 0.6, 0))}, 0, 300),
            301);
}

TEST_F(Choice, WithoutTheWorldABodyInFrontIsNeverIt) {
  begin();
  EXPECT_EQ(framesUntilAnother({asBody(seen(300, 0.9, -0.7))}, std::nullopt, 300), 301);
  EXPECT_EQ(choose({asBody(seen(300, 0.9, -0.7)), asWorld(seen(30, 0.1, 0.3))}), 1)
      << "found again by its tracklets";
}

// Where nothing else is left to compare with, it is remembered that a body was in front.
TEST_F(Choice, ABodyThatHasCoveredTheWholeViewIsNotTheWorld) {
  begin();
  for (int k = 0; k < 12; ++k)
    EXPECT_EQ(choose({asWorld(seen(100 - 8 * k, 0.5 - 0.04 * k, 0.4)),
                      asBody(seen(200 + 20 * k, 0.5 + 0.04 * k, -0.3))}),
              0);
  WorldCandidate alone = asBody(seen(500, 1, 0));
  alone.evidence.votes = 50;  // outliers on the body itself
  EXPECT_EQ(framesUntilAnother({alone}, std::nullopt, 300), 301);
  // What appears behind it is the world as soon as it reaches far enough.
  EXPECT_EQ(choose({alone, seen(10, 0.05, 0.7)}), std::nullopt);
  WorldCandidate fresh = seen(40, 0.15, 0.7);
  fresh.body = kBody + 1;
  fresh.body_before = 10;
  EXPECT_EQ(choose({alone, fresh}), 1);
}

// A few of the world's tracklets that a body has swallowed make it no world.
TEST_F(Choice, ABodyIsNoHeir) {
  begin();
  WorldCandidate body = asBody(seen(60, 0.3, -0.4));
  body.was_world = body.world_before = 10;
  EXPECT_EQ(choose({body}), std::nullopt);
}

TEST_F(Choice, AtASplitThePartThatSurroundsIsTheWorld) {
  begin();
  WorldCandidate truck = asWorld(seen(110, 0.5, -0.5));
  EXPECT_EQ(choose({truck, asWorld(seen(90, 0.5, 0.4))}), 1) << "though it is the smaller part";
  EXPECT_EQ(world_.changes(), 0) << "the world goes on";
}

// Tracklets that ended long ago fill the window still; what is seen of the world is the world.
TEST_F(Choice, ThePartThatHasAPoseGoesOn) {
  begin();
  WorldCandidate gone = asWorld(seen(400, 0, 0));
  gone.evidence = {};
  EXPECT_EQ(choose({gone, asWorld(seen(60, 0.5, 0))}), 1);
  EXPECT_EQ(choose({gone, asBody(seen(60, 0.5, -0.3))}), 0) << "which has no pose: lost";
  EXPECT_EQ(world_.changes(), 0);
}

// A motion that is born among new tracklets has swallowed a few of the world's.
TEST_F(Choice, AFewTrackletsMakeNoHeir) {
  begin();
  WorldCandidate newborn = seen(20, 0.1, -0.3);
  newborn.world_before = 4;
  EXPECT_EQ(choose({newborn}), std::nullopt);
}

TEST_F(Choice, AnotherMotionThatSurroundsTakesOverInTime) {
  begin();
  const std::vector<WorldCandidate> candidates{asWorld(seen(15, 0.05, 0)),
                                               asBody(seen(250, 0.9, 0.3))};
  const int frames = framesUntilAnother(candidates, 0, 100);
  EXPECT_GT(frames, 2) << "not at once";
  EXPECT_LT(frames, 15);
  EXPECT_TRUE(world_.changed());
  EXPECT_EQ(world_.changes(), 1);
}

// A body that was alone in view when all began was the world for want of another.
TEST_F(Choice, AWorldThatWasNeverBesideAnotherGivesWayAtOnce) {
  ASSERT_EQ(choose({seen(30, 0.9, 0)}), 0);
  for (int k = 0; k < 5; ++k) ASSERT_EQ(choose({asWorld(seen(30, 0.9, 0))}), 0);
  const WorldCandidate body = asWorld(seen(30, 0.3, -0.3));
  const WorldCandidate wall = asBody(seen(16, 0.7, 0.5));
  EXPECT_EQ(framesUntilAnother({body, wall}, 0, 20), 1);
  EXPECT_EQ(world_.changes(), 1);
  EXPECT_EQ(framesUntilAnother({asBody(seen(30, 0.3, -0.3)), asWorld(seen(16, 0.7, 0.5))}, 1, 50),
            51);
}

// What has been the other part of the world is taken when the world does not come back.
TEST_F(Choice, WithoutTheWorldABodyThatSurroundsIsItAtLast) {
  begin();
  for (int k = 0; k < 5; ++k)
    EXPECT_EQ(choose({asWorld(seen(200, 0.9, 0)), asBody(seen(200, 0.8, 0))}), 0);
  const std::vector<WorldCandidate> rest{asBody(seen(200, 0.8, 0))};
  const int frames = framesUntilAnother(rest, std::nullopt, 100);
  EXPECT_GT(frames, 5);
  EXPECT_LT(frames, 40);
}

TEST_F(Choice, ANewLabelThatSurroundsIsTheWorldAfterTheDark) {
  begin();
  for (int k = 0; k < 30; ++k) EXPECT_EQ(choose({}), std::nullopt);
  EXPECT_EQ(choose({seen(40, 0.05, -0.3)}), std::nullopt) << "not the first body that is seen";
  EXPECT_EQ(choose({seen(40, 0.05, -0.3), seen(150, 0.8, 0)}), 1);
  EXPECT_TRUE(world_.changed());
}

TEST_F(Choice, WhatRidesWithTheCameraIsNeverTheWorld) {
  WorldCandidate hood = seen(200, 0.3, 0);
  hood.evidence.rides = true;
  EXPECT_EQ(choose({hood, seen(60, 0.25, 0.1)}), 1);
  // It was the world together with the road while the car stood.
  StaticWorld world;
  world.choose({seen(300, 1, 0)}, options_);
  hood = asWorld(hood);
  EXPECT_EQ(world.choose({hood, asWorld(seen(90, 0.6, 0.1))}, options_), 1);
  // Even if the road has lost all its tracklets.
  StaticWorld alone;
  alone.choose({seen(300, 1, 0)}, options_);
  int frames = 0;
  while (alone.choose({hood, asBody(seen(200, 0.7, 0.1))}, options_) != 1 && frames < 100) ++frames;
  EXPECT_LT(frames, 3);
}

TEST_F(Choice, NothingFromNothing) {
  EXPECT_EQ(choose({}), std::nullopt);
  EXPECT_EQ(choose({seen(10, 0.1, 0)}), 0);
  options_.static_world = WorldRule::kSupport;
  EXPECT_EQ(choose({}), std::nullopt);
}

TEST_F(Choice, BySupportTheLargestTakesOver) {
  options_ = paperOptions().trajectory;
  EXPECT_EQ(choose({seen(90, 0.3, 0.4), seen(100, 0.6, -0.4)}), 1);
  EXPECT_EQ(choose({asWorld(seen(40, 0.3, 0.4)), asBody(seen(60, 0.6, -0.4))}), 0);
  EXPECT_EQ(choose({asWorld(seen(40, 0.3, 0.4)), asBody(seen(61, 0.6, -0.4))}), 1);
  EXPECT_TRUE(world_.changed());
}

}  // namespace
}  // namespace mvo
