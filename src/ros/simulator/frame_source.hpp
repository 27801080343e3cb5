// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The frames of a simulated camera, rendered ahead of their time.
#pragma once

#include <functional>
#include <future>
#include <vector>

#include "mvo/sim.hpp"

namespace mvo_ros {

/// Which of n frames is shown at step k if they are played forwards and backwards without a jump.
int toAndFro(int k, int n);

/// Called in turn: a scene's frames without end, or some of them to and fro.
class FrameSource {
 public:
  /// With `prerender` > 0 renders so many frames now, on all cores; `go_on` is asked in between
  /// whether to, and told how many there are.
  FrameSource(mvo::sim::Scene scene, int prerender, const std::function<bool(int)>& go_on);

  mvo::SequenceFrame next();

 private:
  std::future<mvo::SequenceFrame> render(int frame) const;

  mvo::sim::Scene scene_;
  std::vector<mvo::SequenceFrame> rendered_;
  std::future<mvo::SequenceFrame> ahead_;
  int step_ = 0;
};

}  // namespace mvo_ros
