// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/segmentation.hpp"

namespace mvo {

namespace {

constexpr int kMinTracklets = 3;
constexpr int kNoClass = -1;  // of outliers and of ids that lie nowhere

double percent(int part, int whole) { return whole == 0 ? 0 : 100.0 * part / whole; }

bool clearlyMoves(const BodyStates& states, int body, std::size_t frame) {
  const auto found = states.find(body);
  return found != states.end() && found->second[frame].movement == Movement::kMoving;
}

// The most frequent key >= 1 of a count, the lowest on a tie.
std::optional<int> mostFrequent(const std::map<int, int>& counts) {
  std::optional<int> best;
  for (const auto& [id, count] : counts)
    if (!best || count > counts.at(*best)) best = id;
  return best;
}

}  // namespace

double ClassScore::precision() const {
  return percent(true_positives, true_positives + false_positives);
}

double ClassScore::recall() const {
  return percent(true_positives, true_positives + false_negatives);
}

double ClassScore::recallWithoutOutliers() const {
  return percent(true_positives, true_positives + false_negatives - outliers);
}

std::map<int, ClassScore> scoreSegmentation(const MaskedFrames& frames, const BodyStates& states,
                                            const Association& association) {
  std::map<int, ClassScore> scores{{0, {}}};
  for (const auto& [body, ignored] : states) scores[body];
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (const MaskedPoint& point : frames[k]) {
      if (point.near_border) continue;
      const auto known = association.find(point.id);
      const int found = known == association.end() ? kNoClass : known->second;
      const bool scored = point.body == 0 || clearlyMoves(states, point.body, k) ||
                          (found >= 1 && found != point.body);
      if (!scored) continue;
      if (found == point.body) {
        ++scores[point.body].true_positives;
        continue;
      }
      ++scores[point.body].false_negatives;
      if (point.id < 0) ++scores[point.body].outliers;
      if (found != kNoClass) ++scores[found].false_positives;
    }
  return scores;
}

std::vector<std::optional<int>> dominantIds(const MaskedFrames& frames, int body) {
  std::vector<std::optional<int>> dominant;
  for (const auto& points : frames) {
    std::map<int, int> counts;
    int tracklets = 0;
    for (const MaskedPoint& point : points) {
      if (point.body != body || point.id < 1) continue;
      ++counts[point.id];
      ++tracklets;
    }
    dominant.push_back(tracklets < kMinTracklets ? std::nullopt : mostFrequent(counts));
  }
  return dominant;
}

int idSwitches(const std::vector<std::optional<int>>& dominant) {
  int switches = 0;
  std::optional<int> last;
  for (const auto& id : dominant) {
    if (!id) continue;
    if (last && *last != *id) ++switches;
    last = id;
  }
  return switches;
}

double oneLabelPercent(const MaskedFrames& frames, int body, const std::vector<BodyState>& states) {
  std::map<int, int> counts;
  int all = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (states[k].movement != Movement::kMoving) continue;
    for (const MaskedPoint& point : frames[k]) {
      if (point.body != body || point.near_border) continue;
      ++all;
      if (point.id >= 1) ++counts[point.id];
    }
  }
  const auto best = mostFrequent(counts);
  return best ? percent(counts.at(*best), all) : 0;
}

}  // namespace mvo
