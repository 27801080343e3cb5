// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/label_continuity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace mvo {
namespace {

// `count` tracklets in a row that belong to one label.
struct Group {
  TrackletId first = 0;
  int count = 0;
  int label = kOutlier;
};

class Continuity : public testing::Test {
 protected:
  // The ids of `labels` labels supported by groups of tracklets.
  std::vector<LabelId> assign(int labels, const std::vector<Group>& groups) {
    Window window;
    Labeling labeling;
    labeling.labels.resize(labels);
    for (const Group& g : groups)
      for (int i = 0; i < g.count; ++i) {
        window.tracklets.push_back({g.first + i, {}});
        labeling.assignment.push_back(g.label);
      }
    const std::vector<WorldEvidence> none(labels);
    const auto world = world_.choose(continuity_.candidates(window, labeling, none), options_);
    return continuity_.assign(window, labeling, world);
  }

  TrajectoryOptions options_ = paperOptions().trajectory;  // by support, static_hysteresis = 1.5
  StaticWorld world_;
  LabelContinuity continuity_;
};

using Ids = std::vector<LabelId>;

TEST_F(Continuity, TheLargestLabelIsTheStaticWorldAtFirst) {
  EXPECT_EQ(assign(3, {{0, 20, 0}, {100, 60, 1}, {200, 10, 2}}), (Ids{1, kStatic, 2}));
}

TEST_F(Continuity, IdsPersistWhateverTheOrderOfTheLabels) {
  const Ids first = assign(3, {{0, 60, 0}, {100, 20, 1}, {200, 10, 2}});
  EXPECT_EQ(first, (Ids{kStatic, 1, 2}));
  EXPECT_EQ(assign(3, {{0, 60, 2}, {100, 20, 0}, {200, 10, 1}}), (Ids{1, 2, kStatic}));
  // Most tracklets are replaced from window to window.
  EXPECT_EQ(assign(3, {{0, 60, 0}, {115, 20, 1}, {205, 10, 2}}), (Ids{kStatic, 1, 2}));
  EXPECT_EQ(assign(3, {{0, 60, 0}, {130, 20, 1}, {214, 10, 2}}), (Ids{kStatic, 1, 2}));
}

TEST_F(Continuity, TheLargerPartKeepsTheIdAtASplit) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  EXPECT_EQ(assign(3, {{0, 60, 0}, {100, 7, 1}, {107, 13, 2}}), (Ids{kStatic, 2, 1}));
}

TEST_F(Continuity, TheLargerPartGivesTheIdAtAMerger) {
  assign(3, {{0, 60, 0}, {100, 20, 1}, {200, 30, 2}});
  EXPECT_EQ(assign(2, {{0, 60, 0}, {100, 20, 1}, {200, 30, 1}}), (Ids{kStatic, 2}));
}

TEST_F(Continuity, ABodyThatRestedGetsItsIdBack) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  assign(1, {{0, 60, 0}, {100, 20, 0}});
  assign(1, {{0, 60, 0}, {100, 20, 0}});
  EXPECT_EQ(assign(2, {{0, 60, 0}, {100, 20, 1}}), (Ids{kStatic, 1}));
}

TEST_F(Continuity, ABodyThatWasLostToTheOutliersGetsItsIdBack) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  assign(1, {{0, 60, 0}, {100, 20, kOutlier}});
  EXPECT_EQ(assign(2, {{0, 60, 0}, {100, 20, 1}}), (Ids{kStatic, 1}));
}

TEST_F(Continuity, NewLabelsHaveFreshIds) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  assign(1, {{0, 60, 0}});  // body 1 leaves for good
  EXPECT_EQ(assign(2, {{0, 60, 0}, {300, 20, 1}}), (Ids{kStatic, 2}));
  // Part of the static world that starts to move.
  EXPECT_EQ(assign(3, {{0, 45, 0}, {45, 15, 1}, {300, 20, 2}}), (Ids{kStatic, 3, 2}));
}

TEST_F(Continuity, ALabelWithoutTrackletsHasNoIdAndUsesNone) {
  EXPECT_EQ(assign(3, {{0, 60, 0}, {200, 10, 2}}), (Ids{kStatic, kOutlier, 1}));
  EXPECT_EQ(assign(3, {{0, 60, 0}, {100, 12, 1}, {200, 10, 2}}), (Ids{kStatic, 2, 1}));
}

TEST_F(Continuity, ALargerNewcomerDoesNotTakeOverBelowTheHysteresis) {
  assign(1, {{0, 40, 0}});
  EXPECT_EQ(assign(2, {{0, 40, 0}, {100, 60, 1}}), (Ids{kStatic, 1})) << "1.5 times is not more";
  EXPECT_EQ(assign(2, {{0, 40, 0}, {100, 61, 1}}), (Ids{2, kStatic}));
  EXPECT_EQ(assign(2, {{0, 61, 0}, {100, 61, 1}}), (Ids{2, kStatic})) << "and stays there";
}

TEST_F(Continuity, TheStaticWorldGoesOnWhereMostOfItIs) {
  assign(1, {{0, 60, 0}});
  EXPECT_EQ(assign(2, {{0, 25, 0}, {25, 35, 1}}), (Ids{1, kStatic}));
}

TEST_F(Continuity, TheStaticWorldIsChosenAnewWhenNoneOfItIsLeft) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  EXPECT_EQ(assign(2, {{300, 10, 0}, {400, 30, 1}}), (Ids{2, kStatic}));
}

TEST_F(Continuity, IdsAreUniqueInEveryWindow) {
  for (int k = 0; k < 60; ++k) {
    const std::vector<Group> groups{{3 * k, 30, k % 4},
                                    {1000 + 5 * k, 28, (k / 2) % 4},
                                    {2000 + 2 * k, 12, (k / 3) % 4},
                                    {3000, 15, (k / 5) % 4}};
    Ids ids = assign(4, groups);
    for (int l = 3; l >= 0; --l)
      if (std::none_of(groups.begin(), groups.end(), [l](const Group& g) { return g.label == l; }))
        ids.erase(ids.begin() + l);
    EXPECT_EQ(std::set<LabelId>(ids.begin(), ids.end()).size(), ids.size());
    EXPECT_EQ(std::count(ids.begin(), ids.end(), kStatic), 1);
    EXPECT_EQ(std::count(ids.begin(), ids.end(), kOutlier), 0);
  }
}

TEST_F(Continuity, RemembersWhatMayComeBack) {
  assign(3, {{0, 60, 0}, {100, 20, 1}, {200, 10, 2}});
  EXPECT_EQ(continuity_.remembered(), (std::set<LabelId>{1, 2}));
  assign(1, {{0, 60, 0}, {100, 20, 0}});  // one rests, the other's tracklets are gone
  EXPECT_EQ(continuity_.remembered(), (std::set<LabelId>{1}));
  assign(1, {{0, 60, 0}});
  EXPECT_TRUE(continuity_.remembered().empty());
}

// A world that has no label in a window is no other label's, and has its tracklets when it is back.
TEST_F(Continuity, TheWorldOutOfSightIsRememberedByItsTracklets) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  Window window;
  Labeling labeling;
  labeling.labels.resize(1);
  for (TrackletId id = 0; id < 120; ++id)
    if (id < 60 || id >= 100) {
      window.tracklets.push_back({id, {}});
      labeling.assignment.push_back(id < 60 ? kOutlier : 0);
    }
  EXPECT_EQ(continuity_.assign(window, labeling, std::nullopt), (Ids{1}));
  labeling.labels.resize(2);
  for (TrackletId p = 0; p < 60; ++p) labeling.assignment[p] = 1;
  const auto candidates = continuity_.candidates(window, labeling, {});
  EXPECT_EQ(candidates[1].world_before, 60);
  EXPECT_EQ(candidates[1].was_world, 0);
  EXPECT_EQ(candidates[0].world_before, 0);
  EXPECT_EQ(candidates[0].body, 1);
  EXPECT_EQ(candidates[0].body_before, 20);
}

TEST_F(Continuity, NothingFromNothing) {
  EXPECT_TRUE(assign(0, {}).empty());
  EXPECT_TRUE(assign(0, {{0, 20, kOutlier}}).empty());
  EXPECT_EQ(assign(1, {{0, 20, 0}}), (Ids{kStatic}));
  EXPECT_TRUE(assign(0, {}).empty());
  EXPECT_EQ(assign(1, {{0, 20, 0}}), (Ids{kStatic}));
}

// A tracklet that was cut remembers the body it was on, but no longer votes for the static world.
TEST_F(Continuity, RenamedTrackletsRememberTheirBody) {
  assign(2, {{0, 60, 0}, {100, 20, 1}});
  for (int i = 0; i < 20; ++i) continuity_.rename(100 + i, 500 + i);
  EXPECT_EQ(assign(2, {{0, 60, 0}, {500, 20, 1}}), (Ids{kStatic, 1}));
  for (int i = 0; i < 60; ++i) continuity_.rename(i, 600 + i);
  EXPECT_EQ(assign(2, {{600, 60, 0}, {500, 20, 1}}), (Ids{kStatic, 1})) << "by support";
  continuity_.rename(9999, 10000);  // unknown
}

}  // namespace
}  // namespace mvo
