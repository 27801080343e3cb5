// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which label is the static world (III-G), by evidence that is gathered over time, or by
// support as in the paper.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "mvo/options.hpp"
#include "mvo/types.hpp"
#include "trajectories/world_evidence.hpp"

namespace mvo {

/// A label of this window that might be the world.
struct WorldCandidate {
  int support = 0;
  int was_world = 0;        ///< tracklets that were the world's in the last window
  int world_before = 0;     ///< tracklets that were the world's when last they had a label
  int body_before = 0;      ///< tracklets that were one body's then, of the body with most of them
  LabelId body = kOutlier;  ///< that body
  WorldEvidence evidence;
};

/// Remembers how good a world the world was, and how long each body has been a better one.
class StaticWorld {
 public:
  /// The label that is the world.
  /// Evidence: the world goes on in the label that has most of its tracklets, however few. A body
  /// takes over only if it reaches farther around and lies farther behind by a sum over frames, and
  /// never if it has been seen in front of its neighbours, whatever it covers; sooner from a world
  /// that had hardly been beside another label. While the world is
  /// out of sight what is remembered of it fades: another label that surrounds is believed at last,
  /// a new one sooner; until then there is none.
  /// Support: the label that has most of the last window's world, or the largest where there is
  /// none or it is outgrown by options.static_hysteresis; none only without labels.
  std::optional<int> choose(const std::vector<WorldCandidate>& candidates,
                            const TrajectoryOptions& options);

  bool changed() const { return changed_; }  ///< another label took over in the last choice
  int changes() const { return changes_; }   ///< how often one has

 private:
  std::optional<int> bySupport(const std::vector<WorldCandidate>& candidates, double hysteresis);
  std::optional<int> byEvidence(const std::vector<WorldCandidate>& candidates);
  std::optional<int> heir(const std::vector<WorldCandidate>& candidates) const;
  std::optional<int> newcomer(const std::vector<WorldCandidate>& candidates) const;
  std::optional<int> challenger(const std::vector<WorldCandidate>& candidates,
                                std::optional<int> world) const;
  void judgeBodies(const std::vector<WorldCandidate>& candidates, std::optional<int> world);
  void remember(const WorldEvidence& world);
  bool isFamiliar(const WorldCandidate& candidate) const;
  bool isInFront(const WorldCandidate& candidate) const;

  struct Body {
    double lead = 0;    // by which it has looked more like the world, summed over frames
    double behind = 0;  // mean over its frames with neighbours beside the world
    int judged = 0;     // those frames
    int beside = 0;     // frames in which it was seen beside the world
  };

  std::optional<double> value_;  // of the world, when it was last seen, fading
  double behind_ = 0;            // of the same
  int tried_ = 0;                // frames in which it was the world beside other labels
  std::map<LabelId, Body> bodies_;
  bool changed_ = false;
  int changes_ = 0;
};

}  // namespace mvo
