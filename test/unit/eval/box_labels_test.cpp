// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/box_labels.hpp"

#include <gtest/gtest.h>

namespace mvo {
namespace {

// A box 50 px wide and 100 high.
TrueBox box(const std::string& body, double x, const std::string& occluded_by = "") {
  return {0, x, 0, 50, 100, body, occluded_by};
}

std::vector<LabelRow> labels(int id, double u, int n) {
  return std::vector<LabelRow>(static_cast<std::size_t>(n), {0, 0, u, 50, id});
}

std::vector<LabelRow> operator+(std::vector<LabelRow> a, const std::vector<LabelRow>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A at 100..150, B at 300..350.
const std::vector<TrueBox> kTwo{box("A", 100), box("B", 300)};

TEST(OwnLabel, NeedsMostOfTenTrackletsAndFewOutside) {
  const auto own = [&](int inside, int others, int outside) {
    return hasOwnLabel(labels(4, 120, inside) + labels(0, 120, others) + labels(4, 10, outside),
                       box("A", 100));
  };
  EXPECT_TRUE(own(10, 0, 0));
  EXPECT_FALSE(own(9, 0, 0));
  EXPECT_TRUE(own(6, 5, 0));
  EXPECT_FALSE(own(5, 5, 0));
  EXPECT_TRUE(own(12, 0, 3));  // 20 % outside
  EXPECT_FALSE(own(12, 0, 4));
  EXPECT_FALSE(hasOwnLabel(labels(0, 120, 50), box("A", 100)));  // the static world is no car
  EXPECT_FALSE(hasOwnLabel({}, box("A", 100)));
}

TEST(BoxesByFrame, LeaveOutWhatIsInNoFrame) {
  const FrameClock clock({0, 100, 200});
  const FrameBoxes boxes = boxesByFrame(
      clock, {{100, 0, 0, 1, 1, "A", ""}, {205, 0, 0, 1, 1, "B", ""}, {900, 0, 0, 1, 1, "C", ""}});
  ASSERT_EQ(boxes.size(), 3u);
  EXPECT_TRUE(boxes[0].empty());
  EXPECT_EQ(boxes[1].at(0).body, "A");
  ASSERT_EQ(boxes[2].size(), 1u);
  EXPECT_EQ(boxes[2][0].body, "B");
}

TEST(Holders, HoldMostOfFiveTracklets) {
  const auto held = [&](const std::vector<LabelRow>& rows) {
    const FrameBoxes boxes{kTwo};
    return holders("A", {rows}, boxes, ownersOfIds({rows}, boxes)).at(0);
  };
  EXPECT_EQ(held(labels(7, 120, 5)), 7);
  EXPECT_FALSE(held(labels(7, 120, 4)));
  EXPECT_EQ(held(labels(7, 120, 3) + labels(0, 120, 2)), 7);
  EXPECT_FALSE(held(labels(7, 120, 3) + labels(0, 120, 3)));
  EXPECT_FALSE(held(labels(7, 120, 3) + labels(-1, 120, 3)));  // outliers are tracklets, too
  EXPECT_FALSE(held(labels(0, 120, 9)));
  EXPECT_FALSE(held(labels(-1, 120, 9)));
  EXPECT_EQ(held(labels(7, 150, 5) + labels(7, 10, 90)), 7);  // the edge is inside
}

TEST(Holders, AnIdIsOneBodysOnly) {
  const FrameBoxes boxes{kTwo, kTwo, kTwo};
  const FrameLabels rows{labels(1, 120, 8) + labels(2, 320, 8), labels(1, 120, 8),
                         labels(1, 320, 6)};  // B takes the id of A
  const auto owners = ownersOfIds(rows, boxes);
  EXPECT_EQ(owners, (std::map<int, std::string>{{1, "A"}, {2, "B"}}));
  EXPECT_EQ(holders("A", rows, boxes, owners), (Holders{1, 1, std::nullopt}));
  EXPECT_EQ(holders("B", rows, boxes, owners), (Holders{2, std::nullopt, std::nullopt}));
}

TEST(Owners, TrackletsBeforeAHiddenBodyAreTheOthers) {
  const std::vector<TrueBox> hidden{box("A", 100, "B"), box("B", 110)};
  const std::vector<TrueBox> beside{box("A", 100, "pole"), box("B", 110)};
  const FrameLabels rows{labels(1, 120, 8), labels(1, 105, 2)};
  EXPECT_EQ(ownersOfIds(rows, {hidden, hidden}).at(1), "B");
  EXPECT_EQ(ownersOfIds(rows, {beside, beside}).at(1), "A");  // 10 against 8
  EXPECT_TRUE(ownersOfIds({labels(1, 5, 3) + labels(0, 120, 9)}, {hidden}).empty());
}

TEST(BoxedBody, IsFoundInClearFramesAndInAll) {
  const FrameBoxes boxes{{box("A", 100)},         {box("A", 100)}, {box("A", 100, "pole")},
                         {box("A", 100, "pole")}, {box("A", 100)}, {}};
  const FrameLabels rows{
      labels(-1, 120, 9), labels(1, 120, 12) + labels(-1, 120, 8), labels(1, 120, 6),
      labels(0, 120, 6),  labels(3, 120, 6) + labels(-1, 120, 7),  labels(4, 120, 50)};
  const BoxedBody score = scoreBoxedBody("A", rows, boxes, ownersOfIds(rows, boxes));
  EXPECT_EQ(score.frames, 5);
  EXPECT_EQ(score.clear_frames, 3);
  EXPECT_EQ(score.found, 2);
  EXPECT_EQ(score.found_clear, 1);
  EXPECT_EQ(score.found_without_outliers, 2);
  EXPECT_DOUBLE_EQ(score.foundPercent(), 40);
  EXPECT_DOUBLE_EQ(score.foundClearPercent(), 100. / 3);
  EXPECT_EQ(score.first_found, 1u);
  EXPECT_EQ(score.ids, std::vector<int>{1});
  EXPECT_EQ(score.id_switches, 0);
  EXPECT_EQ(score.own_label, 1);
  EXPECT_EQ(score.labels.tracklets, 9 + 20 + 13);  // of the clear frames
  EXPECT_EQ(score.labels.outliers, 9 + 8 + 7);
  EXPECT_TRUE(score.static_frames.empty());  // a pole may be before it
}

TEST(BoxedBody, TheWorldsLabelOnItIsToldByFrame) {
  const FrameBoxes boxes(3, {box("A", 100)});
  const FrameLabels rows{labels(0, 120, 5) + labels(-1, 120, 20),
                         labels(0, 120, 4) + labels(2, 120, 4), labels(0, 120, 4)};
  const BoxedBody score = scoreBoxedBody("A", rows, boxes, {});
  EXPECT_EQ(score.static_frames, std::vector<std::size_t>{0});
  EXPECT_DOUBLE_EQ(score.labels.staticPercent(), 100. * 13 / 37);
  EXPECT_DOUBLE_EQ(score.labels.movingPercent(), 100. * 4 / 37);
}

TEST(BoxedBody, AChangeOfIdIsASwitch) {
  const FrameBoxes boxes(4, {box("A", 100)});
  const FrameLabels rows{labels(1, 120, 5), labels(2, 120, 5), {}, labels(2, 120, 5)};
  const BoxedBody score = scoreBoxedBody("A", rows, boxes, ownersOfIds(rows, boxes));
  EXPECT_EQ(score.ids, (std::vector<int>{1, 2}));
  EXPECT_EQ(score.id_switches, 1);
  EXPECT_EQ(scoreBoxedBody("A", {{}}, {{}}, {}).frames, 0);
}

TEST(Background, IsWhatLiesOutsideOfAllBoxes) {
  const FrameBoxes boxes{kTwo, kTwo, kTwo, {}};
  const FrameLabels rows{
      labels(0, 200, 6) + labels(3, 200, 2) + labels(-1, 200, 2) + labels(5, 120, 99),
      labels(0, 200, 5) + labels(3, 400, 5),  // half is not most
      labels(-1, 200, 5),                     // says nothing
      labels(3, 200, 90)};                    // without boxes
  const BackgroundLabels score = scoreBackground(rows, boxes);
  EXPECT_EQ(score.labels.tracklets, 25);
  EXPECT_DOUBLE_EQ(score.labels.staticPercent(), 44);
  EXPECT_DOUBLE_EQ(score.labels.movingPercent(), 28);
  EXPECT_EQ(score.frames, 2);
  EXPECT_EQ(score.not_static_frames, std::vector<std::size_t>{1});
}

}  // namespace
}  // namespace mvo
