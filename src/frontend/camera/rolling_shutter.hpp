// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rolling shutters: a row is exposed after the one above it, so what moves in the image is seen
// where it was at its row's time. Tracklets know their velocity and can be set back to the frame's.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "kernels/link_residual.hpp"
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
  /// `frames` are remembered at least.
  void addFrame(FrameId frame, double time, bool sensed_depth, int frames);
  /// Looks at the readout that lets the static world's tracklets fit one rigid motion best; whoever
  /// is farther than `threshold` [px] from it counts less. Does nothing unless it is to be found
  /// out.
  void learn(const Window& seen, const Trajectory& world, const std::vector<int>& support,
             const LinkResidual& residual, double threshold, const FrontendOptions& options);
  /// Time from the first to the last row [s]; 0 as long as it is unknown or does not matter.
  double readout(const FrontendOptions& options) const;
  /// The window as a global shutter would have seen it, where that differs.
  std::optional<Window> withGlobalShutter(const Window& seen, const StereoCamera& camera,
                                          const FrontendOptions& options) const;

 private:
  // The readout's squared error: cost - 2 slope readout + information readout^2, with poses
  // eliminated.
  struct Evidence {
    double cost = 0;
    double slope = 0;
    double information = 0;
    double measurements = 0;
    int pairs = 0;
  };
  // A point seen in both frames of a pair.
  struct Row {
    Link link;                // at the present readout
    Eigen::Vector3d by_time;  // derivative of the residual by the readout
  };
  std::vector<Row> rowsOf(const Window& seen, const Trajectory& world,
                          const std::vector<int>& support, const LinkResidual& residual) const;
  std::optional<Evidence> evidenceOf(const std::vector<Row>& rows, double threshold) const;
  double meanPeriod() const;  // between frames [s]
  void decide();

  FrameTimes times_;
  bool sensed_depth_ = false;
  Evidence evidence_;
  double learnt_ = 0;  // readout [s]
};

}  // namespace mvo
