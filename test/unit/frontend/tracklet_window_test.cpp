// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/tracklet_window.hpp"

#include <gtest/gtest.h>

namespace mvo {
namespace {

WindowOptions optionsOf(int frames, int max_gap) {
  WindowOptions options;
  options.frames = frames;
  options.max_gap = max_gap;
  return options;
}

// Points of a frame; u_l = 100 * id + frame tells them apart.
std::vector<Feature> points(FrameId frame, const std::vector<TrackletId>& ids) {
  std::vector<Feature> features;
  for (const TrackletId id : ids)
    features.push_back({id, {100.0 * static_cast<double>(id) + static_cast<double>(frame), 5, 3}});
  return features;
}

std::vector<FrameId> framesOf(const TrackletWindow& window, TrackletId id) {
  std::vector<FrameId> frames;
  const auto index = window.find(id);
  if (!index) return frames;
  for (const Observation& o : window.window().tracklets[*index].observations)
    frames.push_back(o.frame);
  return frames;
}

using Frames = std::vector<FrameId>;

TEST(TrackletWindow, StartsEmpty) {
  const TrackletWindow window(optionsOf(5, 1));
  EXPECT_EQ(window.window().frames(), 0);
  EXPECT_TRUE(window.window().tracklets.empty());
  EXPECT_FALSE(window.find(0));
}

TEST(TrackletWindow, TrackletsEnterWithTheirSecondObservation) {
  TrackletWindow window(optionsOf(5, 1));
  window.add(0, points(0, {4, 7}));
  EXPECT_TRUE(window.window().tracklets.empty());
  window.add(1, points(1, {2, 7}));
  ASSERT_EQ(window.window().tracklets.size(), 1U);
  const Tracklet& t = window.window().tracklets.front();
  EXPECT_EQ(t.id, 7);
  ASSERT_EQ(framesOf(window, 7), (Frames{0, 1}));
  EXPECT_EQ(t.observations[0].y, Eigen::Vector3d(700, 5, 3));
  EXPECT_EQ(t.observations[1].y, Eigen::Vector3d(701, 5, 3));
}

TEST(TrackletWindow, Slides) {
  TrackletWindow window(optionsOf(3, 1));
  for (FrameId k = 0; k < 6; ++k) {
    window.add(k, points(k, {1}));
    EXPECT_EQ(window.window().last_frame, k);
    EXPECT_EQ(window.window().frames(), std::min<FrameId>(k + 1, 3));
  }
  EXPECT_EQ(window.window().first_frame, 3);
  EXPECT_EQ(framesOf(window, 1), (Frames{3, 4, 5}));
}

TEST(TrackletWindow, TrackletsThatLeftTheImageStayUntilTheWindowHasPassed) {
  TrackletWindow window(optionsOf(4, 1));
  window.add(0, points(0, {1}));
  window.add(1, points(1, {1}));
  for (FrameId k = 2; k < 4; ++k) window.add(k, {});
  EXPECT_EQ(framesOf(window, 1), (Frames{0, 1}));
  window.add(4, {});  // one observation is left, which is no link
  EXPECT_FALSE(window.find(1));
  EXPECT_TRUE(window.window().tracklets.empty());
}

TEST(TrackletWindow, GapsStayGaps) {
  TrackletWindow window(optionsOf(6, 1));
  window.add(0, points(0, {1}));
  window.add(1, {});
  window.add(2, points(2, {1}));
  window.add(3, {});
  window.add(4, points(4, {1}));
  EXPECT_EQ(framesOf(window, 1), (Frames{0, 2, 4}));
  EXPECT_EQ(window.window().tracklets.front().find(1), nullptr);
}

TEST(TrackletWindow, SinglePointsAreForgottenAfterTheLongestGap) {
  for (const int max_gap : {0, 1, 3}) {
    TrackletWindow patient(optionsOf(10, max_gap));
    patient.add(0, points(0, {1}));
    for (FrameId k = 1; k <= max_gap; ++k) patient.add(k, {});
    patient.add(max_gap + 1, points(max_gap + 1, {1}));
    EXPECT_EQ(framesOf(patient, 1), (Frames{0, max_gap + 1})) << max_gap;

    TrackletWindow late(optionsOf(10, max_gap));
    late.add(0, points(0, {1}));
    for (FrameId k = 1; k <= max_gap + 1; ++k) late.add(k, {});
    late.add(max_gap + 2, points(max_gap + 2, {1}));
    EXPECT_FALSE(late.find(1)) << max_gap;
  }
}

TEST(TrackletWindow, TrackletsAreSortedById) {
  TrackletWindow window(optionsOf(6, 1));
  window.add(0, points(0, {5, 9}));
  window.add(1, points(1, {3, 5, 9}));
  window.add(2, points(2, {1, 3, 9}));
  window.add(3, points(3, {1, 3, 9}));
  TrackletId last = -1;
  for (const Tracklet& t : window.window().tracklets) {
    EXPECT_GT(t.id, last);
    last = t.id;
    EXPECT_EQ(window.window().tracklets[window.find(t.id).value()].id, t.id);
  }
  EXPECT_EQ(window.window().tracklets.size(), 4U);
}

TEST(TrackletWindow, CutEndsATrackletBeforeItsNewestObservation) {
  TrackletWindow window(optionsOf(6, 1));
  for (FrameId k = 0; k < 4; ++k) window.add(k, points(k, {1, 2}));
  const TrackletId fresh = window.cut(1);
  EXPECT_NE(fresh, 1);
  EXPECT_EQ(framesOf(window, 1), (Frames{0, 1, 2}));
  EXPECT_EQ(framesOf(window, 2), (Frames{0, 1, 2, 3}));
  EXPECT_FALSE(window.find(fresh)) << "a single observation so far";
  EXPECT_EQ(window.trackletOf(1), fresh);
  EXPECT_EQ(window.trackletOf(2), 2);
  window.add(4, points(4, {1, 2}));
  EXPECT_EQ(framesOf(window, 1), (Frames{0, 1, 2}));
  EXPECT_EQ(framesOf(window, fresh), (Frames{3, 4}));
  EXPECT_EQ(window.window().tracklets[window.find(fresh).value()].observations[0].y.x(), 103);
}

TEST(TrackletWindow, ATrackletCanBeCutAgain) {
  TrackletWindow window(optionsOf(8, 1));
  for (FrameId k = 0; k < 3; ++k) window.add(k, points(k, {1}));
  const TrackletId second = window.cut(1);
  for (FrameId k = 3; k < 5; ++k) window.add(k, points(k, {1}));
  const TrackletId third = window.cut(second);
  EXPECT_NE(third, second);
  EXPECT_EQ(window.trackletOf(1), third);
  window.add(5, points(5, {1}));
  EXPECT_EQ(framesOf(window, 1), (Frames{0, 1}));
  EXPECT_EQ(framesOf(window, second), (Frames{2, 3}));
  EXPECT_EQ(framesOf(window, third), (Frames{4, 5}));
}

TEST(TrackletWindow, WhatACutLeavesWithOneObservationIsNoTracklet) {
  TrackletWindow window(optionsOf(6, 1));
  for (FrameId k = 0; k < 2; ++k) window.add(k, points(k, {1}));
  window.cut(1);
  EXPECT_TRUE(window.window().tracklets.empty());
}

TEST(TrackletWindow, CuttingAnUnknownTrackletChangesNothing) {
  TrackletWindow window(optionsOf(6, 1));
  for (FrameId k = 0; k < 2; ++k) window.add(k, points(k, {1}));
  EXPECT_EQ(window.cut(77), 77);
  EXPECT_EQ(framesOf(window, 1), (Frames{0, 1}));
  EXPECT_EQ(window.trackletOf(77), 77);
}

TEST(TrackletWindow, VanishedPointsLeaveNoNames) {
  TrackletWindow window(optionsOf(5, 1));
  const auto renamed = [&window] {
    int count = 0;
    for (TrackletId id = 0; id < 400; ++id) count += window.trackletOf(id) != id ? 1 : 0;
    return count;
  };
  for (FrameId k = 0; k < 400; ++k) {
    // Every point lives four frames and is cut in its third.
    std::vector<TrackletId> ids;
    for (FrameId id = std::max<FrameId>(0, k - 3); id <= k; ++id) ids.push_back(id);
    window.add(k, points(k, ids));
    if (k >= 2) window.cut(k - 2);
    EXPECT_LE(renamed(), 4);
    EXPECT_EQ(renamed() > 0, k >= 2);
  }
  for (FrameId k = 400; k < 403; ++k) window.add(k, {});
  EXPECT_EQ(renamed(), 0);
}

}  // namespace
}  // namespace mvo
