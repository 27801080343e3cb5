// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/motion_lifetimes.hpp"

#include <algorithm>

namespace mvo {

std::vector<DepartedMotion> MotionLifetimes::update(FrameId frame, FrameId oldest_frame,
                                                    const std::vector<LabelId>& resting,
                                                    std::vector<MotionEstimate>& motions) {
  for (MotionEstimate& m : motions) {
    const auto [it, born] = known_.try_emplace(m.id);
    DepartedMotion& life = it->second;
    if (born) life.birth_frame = frame;
    m.state = born ? MotionState::kNew : MotionState::kTracked;
    m.birth_frame = life.birth_frame;
    life = {m.id, m.state, m.T_world_motion, life.birth_frame, frame};
  }
  std::vector<DepartedMotion> departed;
  for (auto it = known_.begin(); it != known_.end();) {
    DepartedMotion& life = it->second;
    const bool rests = std::find(resting.begin(), resting.end(), life.id) != resting.end();
    if (life.last_frame < frame) {
      const bool said = life.state == MotionState::kLost;
      life.state = rests ? MotionState::kStopped : MotionState::kLost;
      if (rests || !said) departed.push_back(life);
    }
    it = !rests && life.last_frame < oldest_frame ? known_.erase(it) : std::next(it);
  }
  return departed;
}

}  // namespace mvo
