// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/tracklet_map.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace mvo {
namespace {

TEST(TrackletMap, IsAMap) {
  std::mt19937 random(1);
  std::map<TrackletId, int> expected;
  TrackletMap<int> map;
  EXPECT_EQ(map.find(0), map.end());
  for (int i = 0; i < 200; ++i) {
    const auto id = static_cast<TrackletId>(random() % 100);
    expected[id] = i;
    map.set(id, i);
  }
  EXPECT_TRUE(std::equal(
      map.begin(), map.end(), expected.begin(), expected.end(),
      [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; }));
  for (TrackletId id = -1; id <= 100; ++id) {
    const auto it = map.find(id);
    const auto known = expected.find(id);
    ASSERT_EQ(it == map.end(), known == expected.end());
    if (it != map.end()) {
      EXPECT_EQ(it->second, known->second);
    }
  }
  map.clear();
  EXPECT_EQ(map.begin(), map.end());
}

}  // namespace
}  // namespace mvo
