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

/// The windows of a scene that goes on for `further` frames after the first. Bodies are on two
/// rings around the image's centre and have a twentieth of the tracklets each, as have the
/// outliers.
inline SyntheticWindow sceneOfMotions(const WindowSize& size, int further) {
  constexpr double kPi = 3.14159265358979;
  constexpr int kShare = 20;
  constexpr double kFirst = 1;      // tracklets in the first frame per point followed at once
  constexpr double kEvery = 0.029;  // and in each frame that follows
  SyntheticOptions o;
  o.frames = size.frames + further;
  const int slots = static_cast<int>(size.tracklets / (kFirst + kEvery * 48));
  o.outliers = slots / kShare;
  const int bodies = size.motions - 1;
  for (int b = 0; b < bodies; ++b) {
    const double angle = 2 * kPi * b / std::max(1, bodies);
    const double ring = b % 2 == 0 ? 1.15 : 1.45;
    SyntheticBody body;
    body.center = {1.3 * ring * std::cos(angle), ring * std::sin(angle), 4.2};
    body.radius = 0.3;
    body.points = slots / kShare;
    body.step << 0.006 * std::cos(1 + 2.4 * b), 0.006 * std::sin(1 + 2.4 * b), 0.003,
        0.008 * std::sin(b), 0.008 * std::cos(b), 0.008;
    o.bodies.push_back(body);
  }
  o.static_points = slots - o.outliers - bodies * (slots / kShare);
  o.camera_step *= 0.5;
  return makeSyntheticWindow(o);
}

/// Its window that begins with a frame.
inline Window windowFrom(const SyntheticWindow& scene, int first, const WindowSize& size) {
  return slice(scene, first, first + size.frames - 1).window;
}

}  // namespace mvo::test
