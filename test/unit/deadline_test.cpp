// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/deadline.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace mvo {
namespace {

TEST(Deadline, NeverPassesWithoutATime) {
  EXPECT_FALSE(Deadline().passed());
  EXPECT_FALSE(Deadline::after(0).passed());
  EXPECT_FALSE(Deadline::after(1e6).passed());
}

TEST(Deadline, PassesAndStaysPassed) {
  const Deadline deadline = Deadline::after(1);
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_TRUE(deadline.passed());
  EXPECT_TRUE(deadline.passed());
}

}  // namespace
}  // namespace mvo
