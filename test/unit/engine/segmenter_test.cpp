// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the engine's memory makes of a new frame.
#include "engine/segmenter.hpp"

#include <gtest/gtest.h>

#include "kernels/link_residual.hpp"
#include "support/synthetic_window.hpp"

namespace mvo {
namespace {

// A static world seen by a camera that moves, without noise.
test::SyntheticWindow world() {
  test::SyntheticOptions o;
  o.frames = 10;
  o.static_points = 60;
  o.min_length = o.frames;
  o.noise = 0;
  return makeSyntheticWindow(o);
}

// The true motion up to the frame before the last, as a window that measured these residuals knows
// it.
Segmenter knowing(const test::SyntheticWindow& scene, double typical_residual) {
  const test::SyntheticWindow before = slice(scene, 0, scene.window.last_frame - 1);
  Segmentation last;
  Label label;
  label.id = kStatic;
  label.trajectory = before.trajectory(0);
  last.labeling.labels.push_back(label);
  last.labeling.assignment = before.truth;
  last.estimates.resize(1);
  last.typical_residual = typical_residual;
  Segmenter segmenter;
  segmenter.remember(before.window, std::move(last));
  return segmenter;
}

TEST(Segmenter, CarriesItsLabelsOnToTheNewestFrame) {
  const test::SyntheticWindow scene = world();
  Segmenter segmenter = knowing(scene, 0);
  EXPECT_TRUE(segmenter.extend(scene.window, scene.camera, {}).empty());
  ASSERT_EQ(segmenter.labels().size(), 1U);
  const auto T_now_first =
      segmenter.labels()[0].trajectory.between(scene.window.last_frame, scene.window.first_frame);
  ASSERT_TRUE(T_now_first);
  EXPECT_LT(
      (*T_now_first * scene.between(0, scene.window.last_frame, 0).inverse()).translation().norm(),
      1e-3);
}

// The law: what "fits" means in the label loop, it means to the newest links.
TEST(Segmenter, BrokenLinksAreJudgedByTheNoiseOfTheImages) {
  const Options options;
  test::SyntheticWindow scene = world();
  const FrameId now = scene.window.last_frame;
  Tracklet& tracklet = scene.window.tracklets.front();
  const auto& o = tracklet.observations;
  const LinkResidual residual(scene.camera, options.noise, options.energy.residual);
  const auto newest = [&] {
    return residual(scene.between(0, now, now - 1), o[o.size() - 2].y, o.back().y);
  };
  while (newest() < 1.5 * options.energy.threshold) tracklet.observations.back().y.y() += 0.1;

  const double clean = options.energy.typical_residual;
  EXPECT_EQ(knowing(scene, clean).extend(scene.window, scene.camera, options),
            std::vector<TrackletId>{tracklet.id});
  EXPECT_TRUE(knowing(scene, 2 * clean).extend(scene.window, scene.camera, options).empty())
      << "twice the noise, twice the threshold";
  Options fixed = options;
  fixed.energy.adaptive = false;
  EXPECT_EQ(knowing(scene, 2 * clean).extend(scene.window, scene.camera, fixed),
            std::vector<TrackletId>{tracklet.id});
}

TEST(Segmenter, KnowsNothingAtFirst) {
  const test::SyntheticWindow scene = world();
  Segmenter segmenter;
  EXPECT_TRUE(segmenter.extend(scene.window, scene.camera, {}).empty());
  EXPECT_TRUE(segmenter.labels().empty());
  EXPECT_EQ(segmenter.segment(scene.window, scene.camera, {}, {}).labeling.labels.size(), 1U);
}

}  // namespace
}  // namespace mvo
