// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The real-time control on a simulated machine: a step costs time per feature, now and over the
// window.
#include "edges/load_shedding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace mvo_ros {
namespace {

constexpr double kPeriod = 66.7;  // ms
constexpr int kWanted = 700;

// Half of the cost follows the features at once, the other half as the window forgets them.
class Machine {
 public:
  double stepMs(const LoadShedding& shedding) {
    const double features = shedding.features(kWanted);
    in_window += (features - in_window) / 15;
    double ms = slowness * (8 + 0.016 * features + 0.016 * in_window);
    const double budget = shedding.budget(kPeriod, 5);
    if (budget > 0) ms = std::min(ms, std::max(budget + 5, 0.7 * ms));
    std::normal_distribution<double> noise(1, 0.08);
    return ms * noise(random) * (++steps % 50 == 0 ? 2.5 : 1);  // and rare slow ones
  }

  double slowness = 1;
  double in_window = kWanted;
  int steps = 0;
  std::mt19937 random{7};
};

struct Course {
  std::vector<double> ms;
  std::vector<int> features;
  int late = 0;     // steps longer than the period, but the rare slow ones
  int changes = 0;  // of direction
};

Course drive(LoadShedding& shedding, Machine& machine, int frames) {
  Course course;
  int direction = 0;
  for (int k = 0; k < frames; ++k) {
    const double ms = machine.stepMs(shedding);
    if (ms > kPeriod && machine.steps % 50 != 0) ++course.late;
    const int before = shedding.features(kWanted);
    shedding.step(ms, kPeriod, kWanted);
    const int after = shedding.features(kWanted);
    if (after != before) {
      const int now = after > before ? 1 : -1;
      if (direction == -now) ++course.changes;
      direction = now;
    }
    course.ms.push_back(ms);
    course.features.push_back(after);
  }
  return course;
}

TEST(LoadShedding, DoesNothingWhereThereIsTime) {
  LoadShedding shedding;
  Machine machine;
  const Course course = drive(shedding, machine, 1000);
  EXPECT_EQ(*std::min_element(course.features.begin(), course.features.end()), kWanted);
  EXPECT_EQ(course.late, 0);
  EXPECT_EQ(shedding.budget(kPeriod, 5), 0);
}

TEST(LoadShedding, SurvivesASuddenSlowdownAndTakesAllBackAfterIt) {
  LoadShedding shedding;
  Machine machine;
  drive(shedding, machine, 100);
  machine.slowness = 3;  // 91 ms with all features
  const Course onset = drive(shedding, machine, 60);
  EXPECT_LT(onset.late, 30);
  const Course slow = drive(shedding, machine, 900);
  EXPECT_EQ(slow.late, 0);
  EXPECT_LE(slow.changes, 1) << "it settles";
  EXPECT_GE(slow.features.back(), LoadShedding::kFewest);
  EXPECT_LT(slow.features.back(), kWanted);
  const std::vector<int> settled(slow.features.end() - 300, slow.features.end());
  EXPECT_EQ(*std::min_element(settled.begin(), settled.end()),
            *std::max_element(settled.begin(), settled.end()));

  machine.slowness = 1;
  const Course recovery = drive(shedding, machine, 1200);
  EXPECT_EQ(recovery.late, 0);
  EXPECT_EQ(recovery.changes, 0) << "upwards only";
  EXPECT_EQ(recovery.features.back(), kWanted);
  EXPECT_EQ(shedding.budget(kPeriod, 5), 0);
}

TEST(LoadShedding, LimitsTimeOnlyWithTheFewestFeatures) {
  LoadShedding shedding;
  Machine machine;
  machine.slowness = 6;  // 77 ms with the fewest
  for (int k = 0; k < 300; ++k) {
    shedding.step(machine.stepMs(shedding), kPeriod, kWanted);
    if (shedding.budget(kPeriod, 5) > 0) {
      EXPECT_EQ(shedding.features(kWanted), LoadShedding::kFewest);
    }
  }
  EXPECT_NEAR(shedding.budget(kPeriod, 5), 48, 1);
  EXPECT_EQ(shedding.budget(kPeriod, 100), 1) << "never no limit by accident";
  machine.slowness = 1;
  drive(shedding, machine, 1500);
  EXPECT_EQ(shedding.budget(kPeriod, 5), 0);
  EXPECT_EQ(shedding.features(kWanted), kWanted);
}

TEST(LoadShedding, WantsNoMoreThanIsWanted) {
  LoadShedding shedding;
  for (int k = 0; k < 100; ++k) shedding.step(200, kPeriod, 100);
  EXPECT_EQ(shedding.features(100), 100) << "fewer than the fewest are asked for";
  EXPECT_GT(shedding.budget(kPeriod, 5), 0);
  for (int k = 0; k < 100; ++k) shedding.step(200, kPeriod, kWanted);
  EXPECT_EQ(shedding.features(kWanted), LoadShedding::kFewest);
  EXPECT_EQ(shedding.features(120), 120);
  shedding.reset();
  EXPECT_EQ(shedding.features(kWanted), kWanted);
}

TEST(FramePeriod, IsTheCamerasAlsoIfFramesGetLost) {
  FramePeriod period;
  EXPECT_FALSE(period.seconds());
  double stamp = 100;
  for (int k = 0; k < 40; ++k) {
    stamp += k % 5 == 0 ? 0.2 : 0.1;
    period.add(stamp, stamp + 0.03, stamp + 0.03);
  }
  period.add(stamp, stamp + 0.04, stamp + 0.04);  // a second image with this stamp
  ASSERT_TRUE(period.seconds());
  EXPECT_NEAR(*period.seconds(), 0.1, 1e-9);
  period.add(3, 3, stamp + 1);  // the clock went back
  EXPECT_FALSE(period.seconds());
}

TEST(FramePeriod, ARecordingPlayedTwiceAsFastHasHalfTheTime) {
  FramePeriod period;
  for (int k = 0; k < 10; ++k) period.add(0.1 * k, 5 + 0.1 * k, 1000 + 0.05 * k);
  ASSERT_TRUE(period.seconds());
  EXPECT_NEAR(*period.seconds(), 0.05, 1e-9);
}

}  // namespace
}  // namespace mvo_ros
