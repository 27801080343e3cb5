// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Eq. (2) by hand.
#include "engine/energy.hpp"

#include <gtest/gtest.h>

namespace mvo {
namespace {

// Four tracklets on a ring, two labels and the outlier label.
Energy ring() {
  Energy energy;
  energy.data.resize(4, 3);
  energy.data << 1, 5, 9,  //
      2, 6, 9,             //
      7, 3, 9,             //
      8, 4, 10;
  energy.edges = {{0, 1, 0.5}, {1, 2, 0.25}, {2, 3, 2}, {0, 3, 0.125}};
  energy.label_cost = Eigen::Vector3d(100, 200, 0);
  return energy;
}

TEST(Energy, SumsResidualSmoothnessAndComplexity) {
  const Energy energy = ring();
  EXPECT_EQ(energy.tracklets(), 4);
  EXPECT_EQ(energy.outlier(), 2);
  EXPECT_DOUBLE_EQ(energy.evaluate({0, 0, 0, 0}), 1 + 2 + 7 + 8 + 100);
  EXPECT_DOUBLE_EQ(energy.evaluate({0, 0, 1, 1}), 1 + 2 + 3 + 4 + 0.25 + 0.125 + 100 + 200);
  EXPECT_DOUBLE_EQ(energy.evaluate({0, 2, 1, 2}), 1 + 9 + 3 + 10 + 2.875 + 300);
}

TEST(Energy, OutliersPayNoLabelCost) {
  EXPECT_DOUBLE_EQ(ring().evaluate({2, 2, 2, 2}), 9 + 9 + 9 + 10);
}

TEST(Energy, ALabelPaysOnceForAllItsTracklets) {
  const Energy energy = ring();
  const double one = energy.evaluate({1, 2, 2, 2});
  EXPECT_DOUBLE_EQ(energy.evaluate({1, 1, 2, 2}) - one, 6 - 9 + 0.25 - 0.5);
}

TEST(Energy, InadmissibleStaysFinite) {
  Energy energy = ring();
  energy.data(0, 0) = Energy::kInadmissible;
  EXPECT_DOUBLE_EQ(energy.evaluate({0, 0, 0, 0}), Energy::kInadmissible + 2 + 7 + 8 + 100);
}

TEST(Energy, OfNothingIsNothing) {
  Energy energy;
  energy.data.resize(0, 3);
  energy.label_cost = Eigen::Vector3d(100, 200, 0);
  EXPECT_EQ(energy.evaluate({}), 0);
}

}  // namespace
}  // namespace mvo
