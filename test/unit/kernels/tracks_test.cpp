// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The largest residual of a tracklet, eight frames at a time, against one pair at a time.
#include "kernels/tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kernels/link_residual.hpp"
#include "support/halves.hpp"
#include "support/synthetic_window.hpp"

namespace mvo {
namespace {

test::SyntheticWindow someTracks() {
  test::SyntheticOptions o;
  o.frames = 30;
  o.gaps = 0.1;
  o.bodies = {{{-0.8, 0, 4}, 0.45, 30, (Vector6d() << 0.05, 0.02, 0, 0, 0, 0.01).finished()}};
  return makeSyntheticWindow(o);
}

using TracksOfBothHalves = test::BothHalves;

TEST_P(TracksOfBothHalves, AgreeWithTheResidualOfOnePair) {
  const test::SyntheticWindow scene = someTracks();
  const TrackArrays tracks(scene.window, scene.camera);
  for (const ResidualModel model : {ResidualModel::kWhitened, ResidualModel::kImageDistance})
    for (int label = 0; label < 2; ++label) {
      const LinkResidual residual(scene.camera, {}, model);
      const Trajectory trajectory = scene.trajectory(label);
      const LabelResiduals residuals(scene.window, tracks, trajectory, residual, false);
      for (std::size_t p = 0; p < scene.window.tracklets.size(); ++p) {
        double expected = -1;
        const auto& o = scene.window.tracklets[p].observations;
        for (std::size_t j = 1; j < o.size(); ++j)
          expected = std::max(expected, residual(*trajectory.between(o[j].frame, o[j - 1].frame),
                                                 o[j - 1].y, o[j].y));
        const Worst worst = residuals.worst(static_cast<int>(p));
        EXPECT_NEAR(worst.shared, expected, 1e-3 * (1 + std::abs(expected))) << p;
        EXPECT_FALSE(worst.missing);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Halves, TracksOfBothHalves,
                         testing::Values(Half::kPortable, Half::kMachine, Half::kTwoRoundings),
                         test::nameOfHalf);

TEST(TrackBits, AreTheSameOnBothHalves) {
  const test::SyntheticWindow scene = someTracks();
  const TrackArrays tracks(scene.window, scene.camera);
  test::expectSameBitsOnBothHalves([&] {
    std::vector<double> outputs;
    for (const ResidualModel model : {ResidualModel::kWhitened, ResidualModel::kImageDistance})
      for (int label = 0; label < 2; ++label) {
        const LinkResidual residual(scene.camera, {}, model);
        const Trajectory trajectory = scene.trajectory(label);
        const LabelResiduals residuals(scene.window, tracks, trajectory, residual, true);
        for (std::size_t p = 0; p < scene.window.tracklets.size(); ++p)
          outputs.push_back(residuals.worst(static_cast<int>(p)).shared);
      }
    return outputs;
  });
}

}  // namespace
}  // namespace mvo
