// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/live_settings.hpp"

namespace mvo_ros {

namespace {

// Calls pair(setting, option) for each setting.
template <class Settings, class AllParameters, class Pair>
void forEachSetting(Settings& s, AllParameters& p, const Pair& pair) {
  pair(s.publish_tf, p.node.publish_tf);
  pair(s.publish_motion_tf, p.node.publish_motion_tf);
  pair(s.publish_points, p.node.publish_points);
  pair(s.publish_segmentation, p.node.publish_segmentation);
  pair(s.publish_path, p.node.publish_path);
  pair(s.realtime, p.node.realtime);
  pair(s.frontend_max_features, p.method.frontend.max_features);
  pair(s.engine_max_rounds, p.method.engine.max_rounds);
  pair(s.engine_time_budget_ms, p.method.engine.time_budget_ms);
  pair(s.proposal_threshold, p.method.proposal.threshold);
  pair(s.energy_threshold, p.method.energy.threshold);
  pair(s.energy_dead_zone, p.method.energy.dead_zone);
  pair(s.energy_smoothness, p.method.energy.smoothness);
  pair(s.energy_label_cost, p.method.energy.label_cost);
  pair(s.engine_min_tracklets, p.method.engine.min_tracklets);
  pair(s.engine_min_frames, p.method.engine.min_frames);
}

}  // namespace

mvo::MvoConfig liveSettings(const Parameters& parameters) {
  mvo::MvoConfig settings = mvo::MvoConfig::__getDefault__();
  forEachSetting(settings, parameters, [](auto& setting, const auto& option) { setting = option; });
  return settings;
}

Parameters withLiveSettings(Parameters parameters, const mvo::MvoConfig& settings) {
  forEachSetting(settings, parameters, [](const auto& setting, auto& option) { option = setting; });
  parameters.node.validate();
  parameters.method.validate();
  return parameters;
}

}  // namespace mvo_ros
