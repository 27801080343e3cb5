// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/label_continuity.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace mvo {

namespace {

using Votes = std::vector<std::map<LabelId, int>>;  // per label: tracklets that knew an id

// Matches labels without an id to ids not in use, most shared tracklets first.
void match(const Votes& votes, std::vector<LabelId>& ids, std::set<LabelId>& used) {
  std::vector<std::tuple<int, int, LabelId>> ranked;  // (-shared, label, id)
  for (std::size_t l = 0; l < votes.size(); ++l)
    for (const auto& [id, shared] : votes[l]) ranked.emplace_back(-shared, static_cast<int>(l), id);
  std::sort(ranked.begin(), ranked.end());
  for (const auto& [shared, l, id] : ranked) {
    if (ids[l] != kOutlier || used.count(id) != 0) continue;
    ids[l] = id;
    used.insert(id);
  }
}

}  // namespace

LabelContinuity::Past LabelContinuity::pastOf(TrackletId id) const {
  const auto it = past_.find(id);
  return it == past_.end() ? Past() : it->second;
}

std::vector<WorldCandidate> LabelContinuity::candidates(
    const Window& window, const Labeling& labels,
    const std::vector<WorldEvidence>& evidence) const {
  std::vector<WorldCandidate> candidates(labels.labels.size());
  Votes bodies(candidates.size());
  for (std::size_t p = 0; p < labels.assignment.size(); ++p) {
    const int l = labels.assignment[p];
    if (l == kOutlier) continue;
    const Past past = pastOf(window.tracklets[p].id);
    ++candidates[l].support;
    if (past.last == kStatic) ++candidates[l].was_world;
    if (past.home == kStatic) ++candidates[l].world_before;
    if (past.home > kStatic) ++bodies[l][past.home];
  }
  for (std::size_t l = 0; l < candidates.size(); ++l) {
    if (l < evidence.size()) candidates[l].evidence = evidence[l];
    for (const auto& [id, shared] : bodies[l])
      if (shared > candidates[l].body_before) {
        candidates[l].body = id;
        candidates[l].body_before = shared;
      }
  }
  return candidates;
}

std::vector<LabelId> LabelContinuity::assign(const Window& window, const Labeling& labels,
                                             std::optional<int> world) {
  const std::size_t count = labels.labels.size();
  std::vector<LabelId> ids(count, kOutlier);
  Votes last(count);
  Votes moved(count);
  std::vector<char> is_held(count, 0);
  std::vector<Past> past(labels.assignment.size());  // per tracklet
  for (std::size_t p = 0; p < past.size(); ++p) {
    past[p] = pastOf(window.tracklets[p].id);
    const int l = labels.assignment[p];
    if (l == kOutlier) continue;
    is_held[l] = 1;
    if (past[p].last > kStatic) ++last[l][past[p].last];
    if (past[p].moved > kStatic) ++moved[l][past[p].moved];
  }
  if (world) ids[*world] = kStatic;
  std::set<LabelId> used;
  match(last, ids, used);
  match(moved, ids, used);
  for (std::size_t l = 0; l < count; ++l)
    if (ids[l] == kOutlier && is_held[l] != 0) ids[l] = next_++;

  past_.clear();
  for (std::size_t p = 0; p < past.size(); ++p) {
    const int l = labels.assignment[p];
    past[p].last = l == kOutlier ? kOutlier : ids[l];
    if (past[p].last > kStatic) past[p].moved = past[p].last;
    if (past[p].last != kOutlier) past[p].home = past[p].last;
    past_.set(window.tracklets[p].id, past[p]);
  }
  return ids;
}

std::vector<LabelId> LabelContinuity::resting(const Window& window) const {
  constexpr int least = 3;  // a rigid motion's
  struct Count {
    int seen = 0;
    int resting = 0;
  };
  std::map<LabelId, Count> counts;
  for (const Tracklet& t : window.tracklets) {
    const auto it = past_.find(t.id);
    if (it == past_.end() || it->second.moved <= kStatic || t.last() != window.last_frame) continue;
    Count& count = counts[it->second.moved];
    ++count.seen;
    if (it->second.last == kStatic) ++count.resting;
  }
  std::vector<LabelId> ids;
  for (const auto& [id, count] : counts)
    if (count.resting >= least && 2 * count.resting > count.seen) ids.push_back(id);
  return ids;
}

std::set<LabelId> LabelContinuity::remembered() const {
  std::set<LabelId> ids;
  for (const auto& [tracklet, past] : past_)
    for (const LabelId id : {past.last, past.moved})
      if (id > kStatic) ids.insert(id);
  return ids;
}

void LabelContinuity::rename(TrackletId from, TrackletId to) {
  const auto it = past_.find(from);
  if (it != past_.end()) past_.set(to, {kOutlier, kOutlier, it->second.moved});
}

}  // namespace mvo
