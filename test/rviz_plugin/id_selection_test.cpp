// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/id_selection.hpp"

#include <gtest/gtest.h>

namespace mvo_rviz {
namespace {

TEST(IdSelection, EmptyTextSelectsEveryId) {
  for (const char* text : {"", "  ", "\t"}) {
    const ParsedIds parsed = parseIds(text);
    EXPECT_EQ(parsed.problem, "") << '\'' << text << '\'';
    EXPECT_TRUE(parsed.ids.contains(0));
    EXPECT_TRUE(parsed.ids.contains(123456));
  }
}

TEST(IdSelection, IdsAndRangesIncludeTheirEnds) {
  const ParsedIds parsed = parseIds(" 1, 3 - 5 ,9-9");
  ASSERT_EQ(parsed.problem, "");
  for (int id = 0; id < 12; ++id)
    EXPECT_EQ(parsed.ids.contains(id), id == 1 || (id >= 3 && id <= 5) || id == 9) << id;
}

TEST(IdSelection, WhatIsNotUnderstoodIsNamedAndSelectsEveryId) {
  const std::pair<const char*, const char*> cases[] = {
      {"1,x", "'x'"},       {"1 2", "'1 2'"},     {"5-3", "'5-3'"},        {"-1", "'-1'"},
      {"1-2-3", "'1-2-3'"}, {"1,,2", "an empty"}, {"1,", "an empty"},      {"1.5", "'1.5'"},
      {"1-", "'1-'"},       {",", "an empty"},    {"99999999999", "'999"}, {"+1", "'+1'"}};
  for (const auto& [text, named] : cases) {
    const ParsedIds parsed = parseIds(text);
    EXPECT_EQ(parsed.problem.find(named), 0U) << text << ": " << parsed.problem;
    EXPECT_TRUE(parsed.ids.contains(7)) << text;
  }
}

}  // namespace
}  // namespace mvo_rviz
