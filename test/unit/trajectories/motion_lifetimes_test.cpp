// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/motion_lifetimes.hpp"

#include <gtest/gtest.h>

namespace mvo {
namespace {

std::vector<MotionEstimate> motionsWithIds(const std::vector<LabelId>& ids) {
  std::vector<MotionEstimate> motions;
  for (const LabelId id : ids) {
    MotionEstimate m;
    m.id = id;
    m.T_world_motion.translation().x() = 10 * id;
    motions.push_back(m);
  }
  return motions;
}

TEST(MotionLifetimes, AnIdIsNewOnce) {
  MotionLifetimes lifetimes;
  auto motions = motionsWithIds({0, 3});
  EXPECT_TRUE(lifetimes.update(5, 0, {}, motions).empty());
  EXPECT_EQ(motions[1].state, MotionState::kNew);
  EXPECT_EQ(motions[1].birth_frame, 5);
  motions = motionsWithIds({0, 3});
  lifetimes.update(6, 0, {}, motions);
  EXPECT_EQ(motions[1].state, MotionState::kTracked);
  EXPECT_EQ(motions[1].birth_frame, 5);
}

TEST(MotionLifetimes, LossIsSaidOnceAndTheIdMayReturn) {
  MotionLifetimes lifetimes;
  auto motions = motionsWithIds({0, 3});
  lifetimes.update(5, 0, {}, motions);
  motions = motionsWithIds({0});
  const auto departed = lifetimes.update(6, 0, {}, motions);
  ASSERT_EQ(departed.size(), 1U);
  EXPECT_EQ(departed[0].id, 3);
  EXPECT_EQ(departed[0].state, MotionState::kLost);
  EXPECT_EQ(departed[0].last_frame, 5);
  EXPECT_EQ(departed[0].T_world_motion.translation().x(), 30);
  EXPECT_TRUE(lifetimes.update(7, 0, {}, motions).empty());
  motions = motionsWithIds({0, 3});
  EXPECT_TRUE(lifetimes.update(8, 0, {}, motions).empty());
  EXPECT_EQ(motions[1].state, MotionState::kTracked);
}

TEST(MotionLifetimes, RestIsSaidInEveryFrameAndOutlivesTheWindow) {
  MotionLifetimes lifetimes;
  auto motions = motionsWithIds({0, 3});
  lifetimes.update(5, 0, {}, motions);
  for (FrameId k = 6; k < 100; ++k) {
    motions = motionsWithIds({0});
    const auto departed = lifetimes.update(k, k - 10, {3}, motions);
    ASSERT_EQ(departed.size(), 1U);
    EXPECT_EQ(departed[0].state, MotionState::kStopped);
    EXPECT_EQ(departed[0].birth_frame, 5);
  }
  const auto gone = lifetimes.update(100, 90, {}, motions);
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_EQ(gone[0].state, MotionState::kLost);
}

TEST(MotionLifetimes, AForgottenIdWouldBeNew) {
  MotionLifetimes lifetimes;
  auto motions = motionsWithIds({3});
  lifetimes.update(5, 0, {}, motions);
  motions.clear();
  lifetimes.update(6, 6, {}, motions);
  motions = motionsWithIds({3});
  lifetimes.update(7, 6, {}, motions);
  EXPECT_EQ(motions[0].state, MotionState::kNew);
}

}  // namespace
}  // namespace mvo
