// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/types.hpp"

#include <algorithm>

namespace mvo {

namespace {

// An isometry is inverted by its transpose, so what a rotation is off by doubles each time that
// poses are expressed in another frame, until it is no rotation any more.
Eigen::Isometry3d orthonormal(Eigen::Isometry3d T) {
  T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return T;
}

}  // namespace

const Observation* Tracklet::find(FrameId frame) const {
  const auto it = std::lower_bound(observations.begin(), observations.end(), frame,
                                   [](const Observation& o, FrameId f) { return o.frame < f; });
  return it != observations.end() && it->frame == frame ? &*it : nullptr;
}

bool Trajectory::has(FrameId frame) const {
  return frame >= first_frame && frame <= lastFrame() && segment[frame - first_frame] >= 0;
}

std::optional<Eigen::Isometry3d> Trajectory::between(FrameId a, FrameId b) const {
  if (!has(a) || !has(b) || segment[a - first_frame] != segment[b - first_frame])
    return std::nullopt;
  if (a == b) return Eigen::Isometry3d::Identity();
  return T_ck_c1[a - first_frame] * T_ck_c1[b - first_frame].inverse();
}

void Trajectory::append(const std::optional<Eigen::Isometry3d>& T_ck_ckm1) {
  if (T_ck_c1.empty() || !T_ck_ckm1) {
    const int next = segment.empty() ? 0 : *std::max_element(segment.begin(), segment.end()) + 1;
    T_ck_c1.push_back(Eigen::Isometry3d::Identity());
    segment.push_back(next);
    return;
  }
  T_ck_c1.push_back(*T_ck_ckm1 * T_ck_c1.back());
  segment.push_back(segment.back());
}

void Trajectory::dropBefore(FrameId frame) {
  if (frame <= first_frame) return;
  if (frame > lastFrame()) {
    *this = Trajectory{frame, {}, {}};
    return;
  }
  const auto n = frame - first_frame;
  T_ck_c1.erase(T_ck_c1.begin(), T_ck_c1.begin() + n);
  segment.erase(segment.begin(), segment.begin() + n);
  first_frame = frame;
  const Eigen::Isometry3d T_c1_old = T_ck_c1.front().inverse();
  const int s = segment.front();
  for (std::size_t k = 0; k < T_ck_c1.size(); ++k)
    if (segment[k] == s) T_ck_c1[k] = orthonormal(T_ck_c1[k] * T_c1_old);
}

std::vector<int> Labeling::support(int label) const {
  std::vector<int> indices;
  for (std::size_t p = 0; p < assignment.size(); ++p)
    if (assignment[p] == label) indices.push_back(static_cast<int>(p));
  return indices;
}

}  // namespace mvo
