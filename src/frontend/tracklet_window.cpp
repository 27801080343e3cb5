// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/tracklet_window.hpp"

#include <algorithm>

namespace mvo {

void TrackletWindow::add(FrameId frame, const std::vector<Feature>& features) {
  if (window_.last_frame < window_.first_frame) window_.first_frame = frame;
  window_.last_frame = frame;
  window_.first_frame = std::max(window_.first_frame, frame - options_.frames + 1);

  std::vector<Tracklet> entering;
  for (const Feature& feature : features) {
    const TrackletId id = trackletOf(feature.id);
    if (const auto alias = of_feature_.find(feature.id); alias != of_feature_.end())
      alias->second.last_seen = frame;
    if (const auto index = find(id)) {
      window_.tracklets[*index].observations.push_back({frame, feature.y});
      continue;
    }
    const auto it = newborn_.find(id);
    if (it == newborn_.end()) {
      newborn_[id] = {id, {{frame, feature.y}}};
    } else {
      it->second.observations.push_back({frame, feature.y});
      entering.push_back(std::move(it->second));
      newborn_.erase(it);
    }
  }

  auto& all = window_.tracklets;
  all.insert(all.end(), std::make_move_iterator(entering.begin()),
             std::make_move_iterator(entering.end()));
  for (Tracklet& t : all) {
    auto& o = t.observations;
    o.erase(o.begin(), std::find_if(o.begin(), o.end(), [this](const Observation& x) {
              return x.frame >= window_.first_frame;
            }));
  }
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Tracklet& t) { return t.observations.size() < 2; }),
            all.end());
  std::sort(all.begin(), all.end(),
            [](const Tracklet& a, const Tracklet& b) { return a.id < b.id; });
  const auto gone = [this, frame](FrameId last) { return last + options_.max_gap < frame; };
  for (auto it = newborn_.begin(); it != newborn_.end();)
    it = gone(it->second.last()) ? newborn_.erase(it) : std::next(it);
  for (auto it = of_feature_.begin(); it != of_feature_.end();)
    it = gone(it->second.last_seen) ? of_feature_.erase(it) : std::next(it);
}

std::optional<int> TrackletWindow::find(TrackletId id) const {
  const auto it =
      std::lower_bound(window_.tracklets.begin(), window_.tracklets.end(), id,
                       [](const Tracklet& t, TrackletId wanted) { return t.id < wanted; });
  if (it == window_.tracklets.end() || it->id != id) return std::nullopt;
  return static_cast<int>(it - window_.tracklets.begin());
}

TrackletId TrackletWindow::trackletOf(TrackletId feature) const {
  const auto it = of_feature_.find(feature);
  return it == of_feature_.end() ? feature : it->second.tracklet;
}

std::vector<SeenTracklet> TrackletWindow::seenTracklets(
    const std::vector<Feature>& features) const {
  std::vector<SeenTracklet> seen;
  seen.reserve(features.size());
  for (const Feature& f : features)
    if (const auto index = find(trackletOf(f.id))) seen.push_back({*index, f.y});
  return seen;
}

TrackletId TrackletWindow::cut(TrackletId tracklet) {
  const auto index = find(tracklet);
  if (!index) return tracklet;
  Tracklet& old = window_.tracklets[*index];
  const TrackletId fresh = next_cut_++;
  const auto it =
      std::find_if(of_feature_.begin(), of_feature_.end(),
                   [tracklet](const auto& entry) { return entry.second.tracklet == tracklet; });
  const TrackletId feature = it == of_feature_.end() ? tracklet : it->first;
  of_feature_[feature] = {fresh, old.last()};
  newborn_[fresh] = {fresh, {old.observations.back()}};
  old.observations.pop_back();
  if (old.observations.size() < 2) window_.tracklets.erase(window_.tracklets.begin() + *index);
  return fresh;
}

}  // namespace mvo
