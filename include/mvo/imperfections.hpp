// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What sets real cameras apart from the exact pair that their calibration claims.
#pragma once

#include <vector>

#include "mvo/options.hpp"

namespace mvo::sim {

/// All zero (factors: one) is the exact pair. The claimed calibration and the truth never change.
/// Angles are about the axes of the optical frame: x right, y down, z forward.
struct Imperfections {
  double right_yaw = 0;       ///< turn of the right eye about y, positive looks outwards [deg]
  double right_pitch = 0;     ///< about x, positive looks up [deg]
  double right_roll = 0;      ///< about z [deg]
  double right_focal = 0;     ///< its focal length is longer by this share
  double right_center_u = 0;  ///< its principal point lies further to the right [px]
  double right_center_v = 0;  ///< further down [px]
  double right_radial = 0;    ///< it sees points half a diagonal off further out, as radius^3 [px]
  double right_tangential = 0;  ///< half a diagonal to either side further to the right [px]
  double right_delay = 0;       ///< it exposes later [s]
  double readout = 0;           ///< first to last row, both eyes; stamps are the middle row's [s]

  double exposure = 1;     ///< factor of the brightness from frame `exposure_frame` on
  int exposure_frame = 0;  ///< first frame of that brightness
  double flicker = 0;      ///< amplitude of the lamps' brightness, a share of it
  double flicker_hz = 50;  ///< its frequency [Hz]
  double defocus = 0;      ///< standard deviation of the lenses' blur [px]
  int jpeg = 0;            ///< quality of compressed images; 0 = not compressed
  double hood = 0;         ///< share of the left image's height covered by what carries the camera
  int dots = 0;            ///< dots that a projector between the eyes throws on what they see

  /// Throws std::invalid_argument: one sentence with the option's name, value and range.
  void validate() const;
};

/// The table over an Imperfections object, which must outlive it.
std::vector<OptionEntry> optionTable(Imperfections& imperfections);

}  // namespace mvo::sim
