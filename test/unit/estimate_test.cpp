// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/estimate.hpp"

#include <gtest/gtest.h>

namespace mvo {
namespace {

TEST(CutShort, NamesWhatWasLeftOut) {
  CutShort cut;
  EXPECT_FALSE(cut.any());
  EXPECT_EQ(cut.text(), "");
  cut.batch = true;
  EXPECT_TRUE(cut.any());
  EXPECT_EQ(cut.text(), "batch");
  cut.refinement = cut.rounds = true;
  EXPECT_EQ(cut.text(), "refinement, rounds, batch");
}

}  // namespace
}  // namespace mvo
