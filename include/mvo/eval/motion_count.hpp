// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Was the right number of motions found? (Fig. 4)
#pragma once

#include <map>
#include <set>
#include <vector>

#include "mvo/eval/body_states.hpp"
#include "mvo/eval/masked_points.hpp"

namespace mvo {

/// States of each body by its number, one entry per frame.
using BodyStates = std::map<int, std::vector<BodyState>>;

/// The motions of one frame, the static world included.
struct MotionCount {
  int found = 0;          ///< ids >= 0 with at least one labelled tracklet
  int least = 1;          ///< the static world and the required bodies
  int most = 1;           ///< and those that may be found
  bool labelled = false;  ///< the frame has any label, outliers included
  bool exact_set =
      false;  ///< exactly one id per body that is found, all required ones, no other id

  bool right() const { return least <= found && found <= most; }
};

/// The ids of a frame's labels, outliers (-1) included.
using FrameIds = std::set<int>;

/// One count per frame. Without an association (no masks) exact_set stays false.
std::vector<MotionCount> countMotions(const std::vector<FrameIds>& ids, const BodyStates& states,
                                      const Association& association);

/// Share of frames [%]; none of no frames is 0.
struct RightNumberRates {
  int frames = 0;
  double all = 0;            ///< right number, all frames
  double after_first_3 = 0;  ///< right number, without the first 3 frames
  double labelled = 0;       ///< right number, of the frames that have labels
  double exact_set = 0;      ///< exact set, all frames
  double exact_set_after_first_3 = 0;
  double exact_set_labelled = 0;
};
RightNumberRates rightNumberRates(const std::vector<MotionCount>& counts);

/// Frames by the number of motions found in them.
std::map<int, int> histogram(const std::vector<MotionCount>& counts);

/// Frames in which at least one tracklet has an id >= 1.
int framesWithThirdParty(const std::vector<FrameIds>& ids);

}  // namespace mvo
