// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs the tests of a kernel on its portable half and on the machine's. All kernels' headers meet
// here, so that no two of them may define the same name.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "kernels/dense.hpp"
#include "kernels/frame_pairs.hpp"
#include "kernels/landmark.hpp"
#include "kernels/lanes.hpp"
#include "kernels/link_lanes.hpp"
#include "kernels/patch.hpp"
#include "kernels/relaxation.hpp"
#include "kernels/tracks.hpp"

namespace mvo::test {

enum class Half { kPortable, kMachine };

/// Takes a half of all kernels while it lives.
class TakesHalf {
 public:
  explicit TakesHalf(Half half) { forcePortable(half == Half::kPortable); }
  ~TakesHalf() { forcePortable(false); }
  TakesHalf(const TakesHalf&) = delete;
  TakesHalf& operator=(const TakesHalf&) = delete;
};

/// A test suite that runs once for each half.
class BothHalves : public testing::TestWithParam<Half> {
 private:
  TakesHalf taken_{GetParam()};
};

inline std::string nameOfHalf(const testing::TestParamInfo<Half>& info) {
  return info.param == Half::kPortable ? "portable" : "machine";
}

}  // namespace mvo::test
