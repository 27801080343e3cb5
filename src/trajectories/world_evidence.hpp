// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a window shows of each label that tells the static world from a body: the world reaches
// around the image, lies behind, and does not ride with a camera that moves.
#pragma once

#include <algorithm>
#include <vector>

#include "mvo/options.hpp"
#include "mvo/segment_motions.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Of one label, by its tracklets that are seen in the window's newest frame.
struct WorldEvidence {
  int seen = 0;        ///< tracklets
  double around = 0;   ///< share of the image's cells with any tracklet in which it has some
  double behind = 0;   ///< [-1, 1]: share of its points that are farther than their neighbour of
                       ///< another label, minus that of those nearer
  int votes = 0;       ///< points that have a neighbour of another label
  bool rides = false;  ///< rests in the camera while a motion that reaches farther around does not
  bool alive = false;  ///< its estimate has a pose in the newest frame

  /// How much it looks like the world, in [-1, 2]: what lies behind counts as far as it reaches
  /// around, so that a far body in a gap is none; a label that rides with the camera has the least.
  double value() const { return rides ? -1 : around + std::min(behind, around); }
};

/// One entry per label.
std::vector<WorldEvidence> worldEvidence(const Window& window, const Segmentation& segmentation,
                                         const StereoCamera& camera, const NoiseOptions& noise);

}  // namespace mvo
