// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/motion_count.hpp"

#include <algorithm>

namespace mvo {

namespace {

constexpr std::size_t kBirth = 3;  // frames a label needs to exist

// Exactly one id on the static world, one on each required body, at most one on each that may be
// found, none on others.
bool isExactSet(const FrameIds& ids, const std::map<int, Role>& roles,
                const Association& association) {
  std::map<int, int> ids_on;
  for (const int id : ids) {
    if (id < 0) continue;
    const auto body = association.find(id);
    if (body == association.end()) return false;
    ++ids_on[body->second];
  }
  if (ids_on[0] != 1) return false;
  for (const auto& [body, role] : roles) {
    const int n = ids_on[body];
    if (n > 1 || (n == 0 && role == Role::kRequired) || (n == 1 && role == Role::kForbidden))
      return false;
  }
  return true;
}

template <typename Select, typename Good>
double percent(const std::vector<MotionCount>& counts, const Select& select, const Good& good) {
  int all = 0;
  int hits = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (!select(k, counts[k])) continue;
    ++all;
    if (good(counts[k])) ++hits;
  }
  return all == 0 ? 0 : 100.0 * hits / all;
}

}  // namespace

std::vector<MotionCount> countMotions(const std::vector<FrameIds>& ids, const BodyStates& states,
                                      const Association& association) {
  std::vector<MotionCount> counts;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    MotionCount count;
    count.found = static_cast<int>(
        std::count_if(ids[k].begin(), ids[k].end(), [](int id) { return id >= 0; }));
    count.labelled = !ids[k].empty();
    std::map<int, Role> roles;
    for (const auto& [body, frames] : states) {
      const Role role = roles[body] = frames[k].role();
      if (role == Role::kRequired) ++count.least;
      if (role != Role::kForbidden) ++count.most;
    }
    count.exact_set = isExactSet(ids[k], roles, association);
    counts.push_back(count);
  }
  return counts;
}

RightNumberRates rightNumberRates(const std::vector<MotionCount>& counts) {
  const auto all = [](std::size_t, const MotionCount&) { return true; };
  const auto later = [](std::size_t k, const MotionCount&) { return k >= kBirth; };
  const auto labelled = [](std::size_t, const MotionCount& count) { return count.labelled; };
  const auto right = [](const MotionCount& count) { return count.right(); };
  const auto exact = [](const MotionCount& count) { return count.exact_set; };
  return {static_cast<int>(counts.size()), percent(counts, all, right),
          percent(counts, later, right),   percent(counts, labelled, right),
          percent(counts, all, exact),     percent(counts, later, exact),
          percent(counts, labelled, exact)};
}

std::map<int, int> histogram(const std::vector<MotionCount>& counts) {
  std::map<int, int> frames;
  for (const MotionCount& count : counts) ++frames[count.found];
  return frames;
}

int framesWithThirdParty(const std::vector<FrameIds>& ids) {
  return static_cast<int>(std::count_if(ids.begin(), ids.end(), [](const FrameIds& frame) {
    return !frame.empty() && *frame.rbegin() >= 1;
  }));
}

}  // namespace mvo
