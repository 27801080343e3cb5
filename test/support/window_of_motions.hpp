// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Synthetic windows of about so many tracklets, frames and motions, for the benchmarks.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/synthetic_window.hpp"

namespace mvo::test {

struct WindowSize {
  int tracklets = 1000;  ///< in the window, about
  int frames = 48;
  int motions = 5;  ///< the static world's included
};

/// A scene that goes on for `further` frames after the first window. Bodies stand on an ellipse
/// around the image's centre, each circles and turns, and together they have half of the tracklets.
inline SyntheticWindow sceneOfMotions(const WindowSize& size, int further) {
  constexpr double kPi = 3.14159265358979;
  constexpr int kOutlierShare = 20;
  constexpr double kPerPoint = 2.24;  // tracklets in 48 frames per point followed at once
  SyntheticOptions o;
  o.frames = size.frames + further;
  const int points = static_cast<int>(size.tracklets / kPerPoint);
  o.outliers = points / kOutlierShare;
  const int bodies = size.motions - 1;
  const int per_body = points / std::max(1, 2 * bodies);
  for (int b = 0; b < bodies; ++b) {
    const double angle = 2 * kPi * b / bodies;
    SyntheticBody body;
    body.center = {1.9 * std::cos(angle), 1.2 * std::sin(angle), 4.2};
    body.radius = 0.3;
    body.points = per_body;
    const double turn = b % 2 == 0 ? 0.06 : -0.05;  // 0.15 m about another centre
    body.step << 0.15 * turn * std::cos(2.4 * b), 0.15 * turn * std::sin(2.4 * b), 0, 0, 0, turn;
    o.bodies.push_back(body);
  }
  o.static_points = points - o.outliers - bodies * per_body;
  o.camera_step *= 0.2;
  return makeSyntheticWindow(o);
}

/// The truth about its first window.
inline Labeling firstLabels(const SyntheticWindow& scene, const WindowSize& size) {
  const SyntheticWindow first = slice(scene, 0, size.frames - 1);
  Labeling labels{{}, first.truth};
  for (int l = 0; l < size.motions; ++l) {
    Trajectory trajectory{0, {}, {}};
    for (int k = 0; k < size.frames; ++k) {
      trajectory.T_ck_c1.push_back(scene.between(l, k, 0));
      trajectory.segment.push_back(0);
    }
    labels.labels.push_back({l, trajectory, l});
  }
  return labels;
}

/// Its window that begins with a frame.
inline Window windowFrom(const SyntheticWindow& scene, int first, const WindowSize& size) {
  return slice(scene, first, first + size.frames - 1).window;
}

}  // namespace mvo::test
