// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs the tests of a kernel on its portable half and on the machine's. All kernels' headers meet
// here, so that no two of them may define the same name.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ios>
#include <string>
#include <vector>

#include "kernels/corners.hpp"
#include "kernels/dense.hpp"
#include "kernels/frame_pairs.hpp"
#include "kernels/landmark.hpp"
#include "kernels/lanes.hpp"
#include "kernels/link.hpp"
#include "kernels/patch.hpp"
#include "kernels/relaxation.hpp"
#include "kernels/tracks.hpp"

namespace mvo::test {

/// Takes a half of all kernels while it lives.
class TakesHalf {
 public:
  explicit TakesHalf(Half half) { chooseHalf(half); }
  ~TakesHalf() { chooseHalf(Half::kMachine); }
  TakesHalf(const TakesHalf&) = delete;
  TakesHalf& operator=(const TakesHalf&) = delete;
};

/// A test suite that runs once for each half.
class BothHalves : public testing::TestWithParam<Half> {
 private:
  TakesHalf taken_{GetParam()};
};

inline std::string nameOfHalf(const testing::TestParamInfo<Half>& info) {
  switch (info.param) {
    case Half::kMachine:
      return "machine";
    case Half::kPortable:
      return "portable";
    default:
      return "two_roundings";
  }
}

inline bool areSameBits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

/// outputs() gives all numbers that a kernel makes of some inputs.
template <typename Outputs>
void expectSameBitsOnBothHalves(const Outputs& outputs) {
  const std::vector<double> machine = outputs();
  const TakesHalf taken(Half::kPortable);
  const std::vector<double> portable = outputs();
  ASSERT_FALSE(machine.empty());
  ASSERT_EQ(machine.size(), portable.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < machine.size(); ++i) {
    if (areSameBits(machine[i], portable[i])) continue;
    if (++different == 1)
      ADD_FAILURE() << "number " << i << " is " << std::hexfloat << machine[i] << " and "
                    << portable[i];
  }
  EXPECT_EQ(different, 0U) << "of " << machine.size();
}

}  // namespace mvo::test
