// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/segmentation.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace mvo {
namespace {

const BodyState kMoves{View::kVisible, Movement::kMoving};
const BodyState kRests{View::kVisible, Movement::kRest};

// 20 x 20 px with body 1 in columns 10..19.
cv::Mat halfMask() {
  cv::Mat mask = cv::Mat::zeros(20, 20, CV_8UC1);
  mask.colRange(10, 20).setTo(1);
  return mask;
}

std::vector<MaskedPoint> points(int id, int body, int n, bool near_border = false) {
  return std::vector<MaskedPoint>(n, {0, id, body, near_border});
}

std::vector<MaskedPoint> operator+(std::vector<MaskedPoint> a, const std::vector<MaskedPoint>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(MaskPoints, TakeTheNearestPixelAndKnowTheBorder) {
  const auto border = [](double u) {
    const auto found = maskPoints({{0, 5, u, 8, 3}}, halfMask());
    return std::make_pair(found.at(0).body, found.at(0).near_border);
  };
  EXPECT_EQ(border(7.4), std::make_pair(0, false));  // 3 px from the first pixel of the body
  EXPECT_EQ(border(7.6), std::make_pair(0, true));   // 2 px
  EXPECT_EQ(border(9.4), std::make_pair(0, true));
  EXPECT_EQ(border(9.6), std::make_pair(1, true));
  EXPECT_EQ(border(11), std::make_pair(1, true));
  EXPECT_EQ(border(12), std::make_pair(1, false));
  EXPECT_EQ(border(19), std::make_pair(1, false));  // the image's edge is no border
}

TEST(MaskPoints, OutsideOfTheImageOrWithoutMaskThereAreNone) {
  EXPECT_TRUE(
      maskPoints({{0, 5, -0.6, 8, 3}, {0, 6, 19.6, 8, 3}, {0, 7, 8, 20, 3}}, halfMask()).empty());
  EXPECT_TRUE(maskPoints({{0, 5, 1, 1, 3}}, cv::Mat()).empty());
}

TEST(Association, GoesToThePlurality) {
  const Association association =
      associate({points(3, 1, 4) + points(3, 2, 3),
                 points(3, 2, 3) + points(4, 0, 2) + points(0, 1, 50) + points(-1, 2, 9)});
  EXPECT_EQ(association, (Association{{0, 0}, {3, 2}, {4, 0}}));
}

TEST(Segmentation, CountsByClass) {
  // id 1 belongs to body 1; in the frame: 8 right and 1 outlier and 1 static on the body, 20 right
  // and 3 wrong on the static world; points at borders do not count.
  const MaskedFrames frames{points(1, 1, 8) + points(-1, 1, 1) + points(0, 1, 1) +
                            points(0, 0, 20) + points(1, 0, 3) + points(0, 1, 100, true)};
  const auto scores = scoreSegmentation(frames, {{1, {kMoves}}}, {{0, 0}, {1, 1}});
  const ClassScore& body = scores.at(1);
  EXPECT_EQ(body.true_positives, 8);
  EXPECT_EQ(body.false_positives, 3);
  EXPECT_EQ(body.false_negatives, 2);
  EXPECT_EQ(body.outliers, 1);
  EXPECT_DOUBLE_EQ(body.precision(), 100.0 * 8 / 11);
  EXPECT_DOUBLE_EQ(body.recall(), 80.0);
  EXPECT_DOUBLE_EQ(body.recallWithoutOutliers(), 100.0 * 8 / 9);
  EXPECT_EQ(scores.at(0).true_positives, 20);
  EXPECT_EQ(scores.at(0).false_negatives, 3);
  EXPECT_EQ(scores.at(0).false_positives, 1);
}

TEST(Segmentation, BodiesThatDoNotMoveOnlyCountWithAnothersId) {
  const MaskedFrames frames{points(0, 1, 5) + points(-1, 1, 5) + points(1, 1, 5) + points(2, 1, 4)};
  const BodyStates states{{1, {kRests}}, {2, {kMoves}}};
  const auto scores = scoreSegmentation(frames, states, {{0, 0}, {1, 1}, {2, 2}});
  EXPECT_EQ(scores.at(1).true_positives, 0);
  EXPECT_EQ(scores.at(1).false_negatives, 4);
  EXPECT_EQ(scores.at(2).false_positives, 4);
  EXPECT_EQ(scores.at(0).false_positives, 0);
}

TEST(Segmentation, NothingToScoreIsZero) {
  const auto scores = scoreSegmentation({}, {{1, {}}}, {{0, 0}});
  EXPECT_EQ(scores.at(1).precision(), 0);
  EXPECT_EQ(scores.at(1).recall(), 0);
}

TEST(IdSwitches, AreChangesOfTheDominantId) {
  const MaskedFrames frames{points(1, 1, 3) + points(2, 1, 2),
                            points(2, 1, 2),  // too few
                            points(1, 1, 3) + points(0, 1, 9),
                            points(2, 1, 3),
                            points(-1, 1, 9),  // none
                            points(2, 1, 5),
                            points(1, 1, 5) + points(7, 2, 50)};
  const auto dominant = dominantIds(frames, 1);
  EXPECT_EQ(dominant, (std::vector<std::optional<int>>{1, {}, 1, 2, {}, 2, 1}));
  EXPECT_EQ(idSwitches(dominant), 2);
  EXPECT_EQ(idSwitches({}), 0);
}

TEST(OneLabel, IsTheShareOfTheCommonestId) {
  const MaskedFrames frames{points(1, 1, 6) + points(2, 1, 2) + points(-1, 1, 1) + points(0, 1, 1),
                            points(2, 1, 50)};  // the body rests
  EXPECT_DOUBLE_EQ(oneLabelPercent(frames, 1, {kMoves, kRests}), 60.0);
  EXPECT_DOUBLE_EQ(oneLabelPercent(frames, 1, {kRests, kRests}), 0.0);
}

}  // namespace
}  // namespace mvo
