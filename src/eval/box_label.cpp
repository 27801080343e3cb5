// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/box_label.hpp"

#include <map>

namespace mvo {

namespace {

constexpr int kMinTracklets = 10;
constexpr int kMaxOutsidePercent = 20;

}  // namespace

bool hasOwnLabel(const std::vector<LabelRow>& labels, const TrueBox& box) {
  std::map<int, int> inside;
  std::map<int, int> all;
  int tracklets = 0;
  for (const LabelRow& label : labels) {
    ++all[label.motion_id];
    if (label.u < box.x || label.u > box.x + box.width || label.v < box.y ||
        label.v > box.y + box.height)
      continue;
    ++tracklets;
    ++inside[label.motion_id];
  }
  if (tracklets < kMinTracklets) return false;
  for (const auto& [id, count] : inside)
    if (id >= 1 && 2 * count > tracklets)
      return 100 * (all[id] - count) <= kMaxOutsidePercent * all[id];
  return false;
}

BoxScore scoreBoxes(const FrameClock& clock, const std::vector<std::vector<LabelRow>>& labels,
                    const std::vector<TrueBox>& boxes) {
  BoxScore score;
  for (const TrueBox& box : boxes) {
    const auto frame = clock.frameOf(box.stamp_ns);
    if (!frame) continue;
    ++score.frames;
    if (hasOwnLabel(labels[*frame], box)) ++score.labelled;
  }
  return score;
}

}  // namespace mvo
