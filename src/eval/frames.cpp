// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/frames.hpp"

namespace mvo {

std::vector<std::vector<LabelRow>> labelsByFrame(const FrameClock& clock,
                                                 const std::vector<LabelRow>& labels) {
  std::vector<std::vector<LabelRow>> by_frame(clock.frames());
  for (const LabelRow& label : labels)
    if (const auto frame = clock.frameOf(label.stamp_ns)) by_frame[*frame].push_back(label);
  return by_frame;
}

double pathLength(const FramePoses& poses) {
  double length = 0;
  const Eigen::Isometry3d* last = nullptr;
  for (const auto& pose : poses) {
    if (!pose) continue;
    if (last != nullptr) length += (pose->translation() - last->translation()).norm();
    last = &*pose;
  }
  return length;
}

}  // namespace mvo
