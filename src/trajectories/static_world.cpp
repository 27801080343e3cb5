// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/static_world.hpp"

#include <algorithm>

namespace mvo {

namespace {

constexpr double kHeirsShare = 0.25;    // of the world's tracklets that make a part of it an heir
constexpr double kOwnShare = 1.0 / 3;   // of an heir's tracklets that have been the world's
constexpr double kShareWeight = 0.5;    // of its share of the world, beside what it looks like
constexpr double kMargin = 0.2;         // by which a body must be the better world to gain
constexpr double kMarginBeside = 0.4;   // the same if it does not lie behind the world
constexpr double kLimit = 2;            // of the gains' sum, above which it takes over...
constexpr int kTried = 8;               // ... from a world so many frames beside other labels
constexpr double kFading = 0.9;         // per frame, of what is remembered of a world out of sight
constexpr double kNewcomerShare = 0.5;  // of the remembered value that a new label needs
constexpr double kLeastValue = 0.25;    // of any label that is taken for the world
constexpr int kFamiliar = 3;  // frames beside the world after which a label is known as a body
constexpr int kFewVotes = 3;  // neighbours from which on depth order is judged
constexpr int kMemory = 60;   // frames over which it is averaged
constexpr double kInFront = -0.15;  // mean of behind, below which a label is in front
constexpr int kFew = 10;            // tracklets seen, below which a label is no challenger

}  // namespace

std::optional<int> StaticWorld::choose(const std::vector<WorldCandidate>& candidates,
                                       const TrajectoryOptions& options) {
  changed_ = false;
  const auto world = options.static_world == WorldRule::kSupport
                         ? bySupport(candidates, options.static_hysteresis)
                         : byEvidence(candidates);
  changes_ += changed_ ? 1 : 0;
  return world;
}

// Only labels with a pose count if there are any.
std::optional<int> StaticWorld::bySupport(const std::vector<WorldCandidate>& candidates,
                                          double hysteresis) {
  if (candidates.empty()) return std::nullopt;
  const bool any_alive = std::any_of(candidates.begin(), candidates.end(),
                                     [](const WorldCandidate& c) { return c.evidence.alive; });
  const auto was = [&](int l) {
    return candidates[l].evidence.alive || !any_alive ? candidates[l].was_world : 0;
  };
  const auto size = [&](int l) {
    return candidates[l].evidence.alive || !any_alive ? candidates[l].support : 0;
  };
  int chosen = 0;
  int largest = 0;
  for (int l = 1; l < static_cast<int>(candidates.size()); ++l) {
    if (was(l) > was(chosen)) chosen = l;
    if (size(l) > size(largest)) largest = l;
  }
  if (was(chosen) != 0 && size(largest) <= hysteresis * size(chosen)) return chosen;
  changed_ = was(chosen) != 0 && largest != chosen;
  return largest;
}

// The part of the world that goes on as the world: of those with many of its tracklets, and no more
// of a body's, the one that looks most like it. Parts that have no pose any more only if no other
// has.
std::optional<int> StaticWorld::heir(const std::vector<WorldCandidate>& candidates) const {
  const auto isHeir = [](const WorldCandidate& c) {
    return c.world_before > c.body_before && c.world_before >= kOwnShare * c.support;
  };
  const bool any_alive =
      std::any_of(candidates.begin(), candidates.end(),
                  [&](const WorldCandidate& c) { return c.evidence.alive && isHeir(c); });
  int all = 0;
  for (const WorldCandidate& c : candidates)
    if (c.evidence.alive || !any_alive) all += c.world_before;
  std::optional<int> best;
  double best_score = 0;
  for (int l = 0; l < static_cast<int>(candidates.size()); ++l) {
    const WorldCandidate& c = candidates[l];
    if (c.evidence.alive != any_alive || !isHeir(c) || c.world_before < kHeirsShare * all) continue;
    const double score = kShareWeight * c.world_before / all + c.evidence.value();
    if (best && score <= best_score) continue;
    best = l;
    best_score = score;
  }
  return best;
}

// A body that moves beside the world.
bool StaticWorld::isFamiliar(const WorldCandidate& candidate) const {
  const auto body = bodies_.find(candidate.body);
  return body != bodies_.end() && body->second.beside >= kFamiliar &&
         2 * candidate.body_before > candidate.support;
}

bool StaticWorld::isInFront(const WorldCandidate& candidate) const {
  const auto body = bodies_.find(candidate.body);
  return body != bodies_.end() && body->second.behind < kInFront;
}

// A label that was no body, when the world is gone or there was none yet.
std::optional<int> StaticWorld::newcomer(const std::vector<WorldCandidate>& candidates) const {
  const bool first = !value_;
  std::optional<int> best;
  double best_score = 0;
  for (int l = 0; l < static_cast<int>(candidates.size()); ++l) {
    const WorldCandidate& c = candidates[l];
    const double value = c.evidence.value();
    if (!first && (!c.evidence.alive || isFamiliar(c) || isInFront(c) ||
                   value < std::max(kLeastValue, kNewcomerShare * *value_)))
      continue;
    // The first label of all is the world even if it is small.
    const double score = first ? value + (c.evidence.alive ? 3 : 0) : value;
    if (best && score <= best_score) continue;
    best = l;
    best_score = score;
  }
  return best;
}

// Where nothing else is seen a label reaches all around and its depth order is unknown: what counts
// is that beside the world.
void StaticWorld::judgeBodies(const std::vector<WorldCandidate>& candidates,
                              std::optional<int> world) {
  const bool in_sight = world && candidates[*world].evidence.alive;
  std::map<LabelId, Body> bodies;
  for (int l = 0; l < static_cast<int>(candidates.size()); ++l) {
    const WorldCandidate& c = candidates[l];
    if (l == world || c.body == kOutlier) continue;
    const auto before = bodies_.find(c.body);
    Body body = before == bodies_.end() ? Body() : before->second;
    if (in_sight && c.evidence.votes >= kFewVotes) {
      ++body.judged;
      body.behind += (c.evidence.behind - body.behind) / std::min(body.judged, kMemory);
    }
    if (in_sight) ++body.beside;
    const double margin = c.evidence.behind > behind_ ? kMargin : kMarginBeside;
    if (c.evidence.alive && c.evidence.seen >= kFew)
      body.lead = std::max(0.0, body.lead + c.evidence.value() - *value_ - margin);
    bodies[c.body] = body;
  }
  bodies_ = std::move(bodies);
}

std::optional<int> StaticWorld::challenger(const std::vector<WorldCandidate>& candidates,
                                           std::optional<int> world) const {
  std::optional<int> best;
  double best_lead = kLimit * std::min(1.0, static_cast<double>(tried_) / kTried);
  for (int l = 0; l < static_cast<int>(candidates.size()); ++l) {
    const WorldCandidate& c = candidates[l];
    const auto body = bodies_.find(c.body);
    if (l == world || body == bodies_.end() || !c.evidence.alive ||
        c.evidence.value() < kLeastValue || isInFront(c) || body->second.lead <= best_lead)
      continue;
    best = l;
    best_lead = body->second.lead;
  }
  return best;
}

void StaticWorld::remember(const WorldEvidence& world) {
  value_ = world.value();
  behind_ = world.behind;
}

std::optional<int> StaticWorld::byEvidence(const std::vector<WorldCandidate>& candidates) {
  const bool first = !value_;
  const std::optional<int> world = first ? newcomer(candidates) : heir(candidates);
  const bool in_sight = world && candidates[*world].evidence.alive;
  if (in_sight)
    remember(candidates[*world].evidence);
  else if (value_)
    *value_ *= kFading;
  if (!value_) return world;
  judgeBodies(candidates, world);
  const auto seen = std::count_if(candidates.begin(), candidates.end(), [](const auto& c) {
    return c.evidence.alive && c.evidence.seen >= kFew;
  });
  std::optional<int> other = challenger(candidates, world);
  if (!other && !in_sight) other = newcomer(candidates);
  if (seen > 1) tried_ = first ? kTried : tried_ + 1;
  if (!other || other == world) return world;
  tried_ = kTried;
  remember(candidates[*other].evidence);
  for (auto& [id, body] : bodies_) body.lead = 0;
  changed_ = true;
  return other;
}

}  // namespace mvo
