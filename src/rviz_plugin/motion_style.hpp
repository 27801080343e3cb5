// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a person chose of the display's properties.
#pragma once

#include "rviz_plugin/id_selection.hpp"

namespace mvo_rviz {

/// Each element of a motion's picture, whether and how large. The values are the display's
/// defaults.
struct MotionStyle {
  bool axes = true;
  float axes_length = 0.3F;  ///< [m]
  bool trail = true;
  float trail_width = 0.02F;  ///< [m]
  int trail_length = 0;       ///< [poses]; 0: the whole window
  bool velocity = true;
  float velocity_seconds = 1;  ///< the arrow ends where the body will be after this time [s]
  bool box = true;
  float box_line_width = 0.01F;  ///< of its edges [m]
  bool covariance = true;
  float sigmas = 3;  ///< half axes of the ellipsoid in standard deviations
  bool text = true;
  float text_height = 0.18F;  ///< [m]
  bool hide_static = false;
  IdSelection ids;
  float alpha = 1;
};

}  // namespace mvo_rviz
