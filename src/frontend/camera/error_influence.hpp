// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the pair's own error, as far as it is not known, makes of the motions: all points of a
// window err alike, so that no number of them averages it out.
#pragma once

#include <map>

#include "frontend/camera/camera_errors.hpp"
#include "mvo/segment_motions.hpp"

namespace mvo {

/// Remembers by how much each motion's steps move with the error's numbers.
class ErrorInfluence {
 public:
  /// Adds to the covariances of a window's motions, whose labels have ids, those that come of the
  /// uncertain numbers.
  void addTo(Segmentation& segmentation, const Window& corrected, const CameraErrors& errors,
             const LinkResidual& residual);

 private:
  using Influence = Eigen::Matrix<double, 6, kErrorTerms>;
  using Steps = std::map<FrameId, Influence>;  // of the step into a frame, in its camera

  std::map<LabelId, Steps> steps_;
};

}  // namespace mvo
