// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The largest residual of each tracklet under a label, eight frames at a time: measurements and
// transforms lie frame after frame.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/link.hpp"
#include "kernels/link_residual.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Over the pairs of one tracklet.
struct Worst {
  double shared = -1;    ///< pairs that the label has a transform for [px]; negative: none
  bool missing = false;  ///< is there a pair that it has none for?
};

/// A window's measurements, tracklet by tracklet; NaN in gaps and for a few frames behind each
/// tracklet, where lanes may reach.
class TrackArrays {
 public:
  TrackArrays(const Window& window, const StereoCamera& camera);

 private:
  friend class LabelResiduals;
  struct Span {
    int first = 0;  // counted from the window's first frame
    int last = 0;
    std::size_t begin = 0;  // of its first frame in the arrays
    bool whole = true;      // seen in all of its frames
  };
  std::vector<Span> spans_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> d_;
  std::vector<int> rank_;  // observations that follow in the tracklet
};

/// The residuals of a window under one label: consecutive observations and, if wished, pairs
/// several frames apart.
class LabelResiduals {
 public:
  LabelResiduals(const Window& window, const TrackArrays& tracks, const Trajectory& trajectory,
                 const LinkResidual& residual, bool long_pairs);

  Worst worst(int tracklet) const;

 private:
  // T_b_a of all pairs with the same number of frames between them, entry by entry, each entry over
  // all frames b; NaN without a transform.
  struct Step {
    int frames = 1;
    int thinning = 1;  // of how many pairs one is taken
    std::vector<float> T_b_a;
  };
  // Consecutive observations with a gap between them.
  void addGaps(const Tracklet& tracklet, Worst& worst) const;

  const Window& window_;
  const TrackArrays& tracks_;
  const Trajectory& trajectory_;
  const LinkResidual& residual_;
  LinkConstants<EightLinks> constants_;
  ResidualModel model_;
  int stride_;  // between the entries of a transform
  std::vector<Step> steps_;
};

}  // namespace mvo
