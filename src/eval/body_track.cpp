// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/body_track.hpp"

#include <limits>
#include <optional>

#include "eval/alignment.hpp"

namespace mvo {

namespace {

constexpr int kMinCommonFrames = 3;

int supportOf(const Supports& supports, std::size_t frame, int id) {
  if (frame >= supports.size()) return 0;
  const auto found = supports[frame].find(id);
  return found == supports[frame].end() ? 0 : found->second;
}

int commonFrames(const FramePoses& a, const FramePoses& b) {
  int common = 0;
  for (std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    if (a[k] && b[k]) ++common;
  return common;
}

}  // namespace

BodyTrack trackBody(int body, const MotionPoses& motions, const Association& association,
                    const FramePoses& truth, const Eigen::Isometry3d& A, const Supports& supports) {
  BodyTrack track;
  track.poses.resize(truth.size());
  std::vector<bool> duplicate(truth.size(), false);
  for (const auto& [id, poses] : motions) {
    const auto belongs = association.find(id);
    if (belongs == association.end() || belongs->second != body) continue;
    const auto alignment = alignBody(poses, truth, A);
    if (!alignment) continue;
    track.ids.push_back(id);
    for (std::size_t k = 0; k < truth.size() && k < poses.size(); ++k) {
      if (!poses[k]) continue;
      auto& pose = track.poses[k];
      if (pose) duplicate[k] = true;
      if (!pose || supportOf(supports, k, id) > supportOf(supports, k, pose->id))
        pose = AlignedPose{id, (*alignment)(*poses[k])};
    }
  }
  for (const bool is_duplicate : duplicate) track.duplicate_frames += is_duplicate ? 1 : 0;
  return track;
}

Association associateByMotion(const MotionPoses& motions, const std::map<int, FramePoses>& bodies,
                              const Eigen::Isometry3d& A) {
  Association association{{0, 0}};
  for (const auto& [id, poses] : motions) {
    if (id < 1) continue;
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [body, truth] : bodies) {
      const int common = commonFrames(poses, truth);
      if (common < kMinCommonFrames) continue;
      const double cost = misfit(*alignBody(poses, truth, A, common), poses, truth, common);
      if (cost >= best) continue;
      best = cost;
      association[id] = body;
    }
  }
  return association;
}

}  // namespace mvo
