// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rolling shutters: a row is exposed after the one above it, so what moves in the image is seen
// where it was at its row's time. Tracklets know their velocity and can be set back to the frame's.
#pragma once

#include <map>
#include <vector>

#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Stamps of frames [s].
using FrameTimes = std::map<FrameId, double>;

/// The window as a global shutter would have seen it when each frame's middle row was exposed:
/// every observation moved along its tracklet's own image velocity, whatever body it is on. Depth
/// images are taken at once, so `sensed_depth` leaves disparities as they are.
Window withGlobalShutter(const Window& seen, const FrameTimes& times, const StereoCamera& camera,
                         double readout, bool sensed_depth);

/// Knows, or finds out while frames go by, how long the camera reads out its rows.
class RollingShutter {
 public:
  RollingShutter(const StereoCamera& camera, const Options& options);

  void addFrame(FrameId frame, double time, bool sensed_depth);
  /// Looks at the readout that lets the static world's tracklets fit one rigid motion best. Does
  /// nothing unless it is to be found out.
  void learn(const Window& seen, const Trajectory& world, const std::vector<int>& support);
  /// Time from the first to the last row [s]; 0 as long as it is unknown or does not matter.
  double readout() const { return readout_; }
  Window withGlobalShutter(const Window& seen) const;

 private:
  // Of the readout's squared error: cost - 2 slope readout + information readout^2, poses
  // eliminated.
  struct Evidence {
    double cost = 0;
    double slope = 0;
    double information = 0;
    double measurements = 0;
    int pairs = 0;
  };
  double meanPeriod() const;  // between frames [s]
  void decide();

  StereoCamera camera_;
  Options options_;
  FrameTimes times_;
  bool sensed_depth_ = false;
  Evidence evidence_;
  double readout_ = 0;
};

}  // namespace mvo
