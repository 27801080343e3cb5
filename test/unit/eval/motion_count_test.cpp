// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/motion_count.hpp"

#include <gtest/gtest.h>

#include "support/trajectories.hpp"

namespace mvo {
namespace {

using test::transform;

// A body that covers a share of the image, with a share of it in view.
BodyVisibility shown(double image_share, double visible_share) {
  BodyVisibility visibility;
  visibility.image_share = image_share;
  visibility.visible_share = visible_share;
  return visibility;
}

const BodyVisibility kFullyVisible = shown(0.05, 1.0);

// A body along x [m], frame by frame.
FramePoses alongX(const std::vector<double>& x) {
  FramePoses poses;
  for (const double value : x) poses.emplace_back(transform(value, 0, 0));
  return poses;
}

TEST(View, FollowsTheLimits) {
  EXPECT_EQ(viewOf(shown(0.010, 0.60)), View::kVisible);
  EXPECT_EQ(viewOf(shown(0.0099, 1.0)), View::kPartly);
  EXPECT_EQ(viewOf(shown(0.5, 0.599)), View::kPartly);
  EXPECT_EQ(viewOf(shown(0.001, 0.0)), View::kPartly);
  EXPECT_EQ(viewOf(shown(0.00099, 1.0)), View::kGone);
  EXPECT_EQ(viewOf({}), View::kGone);
}

TEST(Movement, MoreThan20Millimetres) {
  EXPECT_EQ(movements(alongX({0, 0.0201}))[1], Movement::kMoving);
  EXPECT_EQ(movements(alongX({0, 0.0199}))[1], Movement::kUnclear);
  EXPECT_EQ(movements(alongX({0, 0.0021}))[1], Movement::kUnclear);
  EXPECT_EQ(movements(alongX({0, 0.0019}))[1], Movement::kRest);
}

TEST(Movement, OrMoreThanOneDegree) {
  const auto turned = [](double degrees) {
    return movements({transform(0, 0, 0), transform(0, 0, 0, 0, 0, degrees * M_PI / 180)})[1];
  };
  EXPECT_EQ(turned(1.01), Movement::kMoving);
  EXPECT_EQ(turned(0.99), Movement::kUnclear);
  EXPECT_EQ(turned(0.09), Movement::kRest);
}

TEST(Movement, AWholeSwingBackToTheStartIsMotion) {
  EXPECT_EQ(movements(alongX({0, 0.03, 0}))[2], Movement::kMoving);
}

TEST(Movement, IsForgottenAfter48Frames) {
  std::vector<double> x(200, 0.1);  // arrives in frame 60 and rests
  for (int k = 0; k < 60; ++k) x[k] = 0;
  const auto moves = movements(alongX(x));
  EXPECT_EQ(moves[59], Movement::kRest);
  EXPECT_EQ(moves[60], Movement::kMoving);
  EXPECT_EQ(moves[60 + 46], Movement::kMoving);  // frame 59 is 47 frames back: the 48th of them
  EXPECT_EQ(moves[60 + 47], Movement::kRest);
}

TEST(Movement, InTheFirst47FramesAMotionToComeIsUnclear) {
  const auto starting = [](int start) {  // the first frame that is away from rest
    std::vector<double> x(100, 0);
    for (int k = start; k < 100; ++k) x[k] = 0.1;
    return movements(alongX(x));
  };
  EXPECT_EQ(starting(20)[0], Movement::kUnclear);
  EXPECT_EQ(starting(20)[19], Movement::kUnclear);
  EXPECT_EQ(starting(20)[20], Movement::kMoving);
  EXPECT_EQ(starting(47)[46], Movement::kUnclear);
  EXPECT_EQ(starting(48)[46], Movement::kRest);
  EXPECT_EQ(starting(48)[47], Movement::kRest);
}

TEST(Movement, WithoutAPoseIsUnclear) {
  FramePoses poses = alongX({0, 0, 0});
  poses[1].reset();
  EXPECT_EQ(movements(poses)[1], Movement::kUnclear);
  EXPECT_EQ(movements(poses)[2], Movement::kRest);
  EXPECT_TRUE(movements({}).empty());
}

TEST(Role, RequiredForbiddenOrEither) {
  EXPECT_EQ((BodyState{View::kVisible, Movement::kMoving}.role()), Role::kRequired);
  EXPECT_EQ((BodyState{View::kPartly, Movement::kMoving}.role()), Role::kEither);
  EXPECT_EQ((BodyState{View::kVisible, Movement::kUnclear}.role()), Role::kEither);
  EXPECT_EQ((BodyState{View::kGone, Movement::kMoving}.role()), Role::kForbidden);
  EXPECT_EQ((BodyState{View::kGone, Movement::kUnclear}.role()), Role::kForbidden);
  EXPECT_EQ((BodyState{View::kVisible, Movement::kRest}.role()), Role::kForbidden);
}

TEST(Stretches, EndWhereTheBodyIsGone) {
  const BodyState seen{View::kVisible, Movement::kMoving};
  const BodyState partly{View::kPartly, Movement::kMoving};
  const BodyState gone{View::kGone, Movement::kMoving};
  const auto stretches = stretchesInView({gone, seen, partly, gone, gone, partly});
  ASSERT_EQ(stretches.size(), 2u);
  EXPECT_EQ(stretches[0].first, 1u);
  EXPECT_EQ(stretches[0].last, 2u);
  EXPECT_EQ(stretches[1].first, 5u);
  EXPECT_EQ(stretches[1].last, 5u);
  EXPECT_TRUE(stretchesInView({gone}).empty());
}

// Body 1 is required, body 2 either, body 3 forbidden; ids 11, 12, 13 belong to them, 9 to the
// static world.
class Counting : public ::testing::Test {
 protected:
  MotionCount count(const FrameIds& ids) const {
    return countMotions({ids}, states_, association_).front();
  }

  BodyStates states_{{1, {{View::kVisible, Movement::kMoving}}},
                     {2, {{View::kPartly, Movement::kMoving}}},
                     {3, {{View::kVisible, Movement::kRest}}}};
  Association association_{{0, 0}, {9, 0}, {11, 1}, {12, 2}, {13, 3}, {21, 1}};
};

TEST_F(Counting, TheRangeIsStaticAndRequiredToEither) {
  const MotionCount exact = count({-1, 0, 11});
  EXPECT_EQ(exact.found, 2);
  EXPECT_EQ(exact.least, 2);
  EXPECT_EQ(exact.most, 3);
  EXPECT_TRUE(exact.right());
  EXPECT_TRUE(exact.exact_set);
  EXPECT_TRUE(count({0, 11, 12}).right());
  EXPECT_TRUE(count({0, 11, 12}).exact_set);
  EXPECT_FALSE(count({0}).right());
  EXPECT_FALSE(count({0, 11, 12, 13}).right());
}

TEST_F(Counting, TheExactSetAsksForTheRightOnes) {
  EXPECT_TRUE(count({0, 13}).right());  // two motions, but of a body at rest
  EXPECT_FALSE(count({0, 13}).exact_set);
  EXPECT_FALSE(count({0, 11, 21}).exact_set);  // two ids on one body
  EXPECT_FALSE(count({0, 11, 9}).exact_set);   // a second static world
  EXPECT_FALSE(count({11, 12}).exact_set);     // no static world
  EXPECT_FALSE(count({0, 11, 99}).exact_set);  // an id that lies nowhere
}

TEST_F(Counting, AFrameWithoutLabelsIsWrong) {
  EXPECT_EQ(count({}).found, 0);
  EXPECT_FALSE(count({}).right());
  EXPECT_FALSE(count({}).labelled);
  EXPECT_EQ(count({-1}).found, 0);
  EXPECT_TRUE(count({-1}).labelled);
}

TEST_F(Counting, ASceneThatStandsStillHasOneMotion) {
  const auto counts = countMotions({{0}, {0, 1}}, {}, {{0, 0}, {1, 0}});
  EXPECT_TRUE(counts[0].right());
  EXPECT_TRUE(counts[0].exact_set);
  EXPECT_FALSE(counts[1].right());
}

TEST(RightNumber, RatesOfAllLaterAndLabelledFrames) {
  // static world alone; frames 0..2 without labels, then right, right, wrong, without labels, right
  const std::vector<FrameIds> ids{{}, {}, {}, {0}, {0}, {0, 5}, {}, {-1, 0}};
  const auto counts = countMotions(ids, {}, {{0, 0}, {5, 0}});
  const RightNumberRates rates = rightNumberRates(counts);
  EXPECT_EQ(rates.frames, 8);
  EXPECT_DOUBLE_EQ(rates.all, 100.0 * 3 / 8);
  EXPECT_DOUBLE_EQ(rates.after_first_3, 100.0 * 3 / 5);
  EXPECT_DOUBLE_EQ(rates.labelled, 100.0 * 3 / 4);
  EXPECT_DOUBLE_EQ(rates.exact_set, 100.0 * 3 / 8);
  EXPECT_EQ(histogram(counts), (std::map<int, int>{{0, 4}, {1, 3}, {2, 1}}));
  EXPECT_EQ(framesWithThirdParty(ids), 1);
  EXPECT_EQ(rightNumberRates({}).all, 0);
}

TEST(BodyStates, JoinViewAndMovement) {
  const auto states = bodyStates(alongX({0, 0.1}), {kFullyVisible, shown(0.0, 0.0)});
  EXPECT_EQ(states[0].view, View::kVisible);
  EXPECT_EQ(states[0].movement, Movement::kUnclear);
  EXPECT_EQ(states[1].view, View::kGone);
  EXPECT_EQ(states[1].movement, Movement::kMoving);
}

}  // namespace
}  // namespace mvo
