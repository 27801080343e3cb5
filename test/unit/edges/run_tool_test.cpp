// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Exit status and sentence of programs that end well, badly, and by a signal.
#include "edges/run_tool.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace mvo {
namespace {

TEST(RunTool, TheStatusIsThatOfTheWork) {
  EXPECT_EQ(runTool("tool", [] { return 0; }), 0);
  EXPECT_EQ(runTool("tool", [] { return 7; }), 7);
}

TEST(RunTool, WhatIsThrownIsASentence) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(runTool("tool", []() -> int { throw std::runtime_error("no such file"); }), 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "tool: no such file\n");
}

TEST(RunInterruptibleTool, ASignalEndsTheWorkThatAsks) {
  testing::internal::CaptureStderr();
  const int status = runInterruptibleTool("tool", [](const Interrupted& interrupted) {
    EXPECT_FALSE(interrupted());
    std::raise(SIGTERM);
    if (interrupted()) throw std::runtime_error("interrupted");
  });
  EXPECT_EQ(status, 128 + SIGTERM);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "tool: interrupted\n");
}

TEST(RunInterruptibleTool, WorkThatWasDoneBeforeTheSignalWasSeenIsDone) {
  EXPECT_EQ(runInterruptibleTool("tool", [](const Interrupted&) { std::raise(SIGINT); }), 0);
  // The next run starts without the signal of the last.
  EXPECT_EQ(runInterruptibleTool(
                "tool", [](const Interrupted& interrupted) { EXPECT_FALSE(interrupted()); }),
            0);
}

}  // namespace
}  // namespace mvo
