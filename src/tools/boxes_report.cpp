// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/boxes_report.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/report_text.hpp"

namespace mvo_tools {

namespace {

using Json = nlohmann::ordered_json;
using mvo::VelocityScore;

Json sharesJson(const mvo::LabelShares& shares) {
  return {{"tracklets", shares.tracklets},
          {"static_pct", shares.staticPercent()},
          {"moving_pct", shares.movingPercent()},
          {"outlier_pct", shares.outlierPercent()}};
}

Json boxedBodyJson(const mvo::BoxedBody& body) {
  Json json = {{"body", body.body},
               {"frames", body.frames},
               {"clear_frames", body.clear_frames},
               {"found_frames", body.found},
               {"found_clear_frames", body.found_clear},
               {"found_clear_without_outliers_frames", body.found_without_outliers},
               {"found_pct", body.foundPercent()},
               {"found_clear_pct", body.foundClearPercent()},
               {"ids", body.ids},
               {"id_switches", body.id_switches},
               {"own_label_frames", body.own_label},
               {"labels", sharesJson(body.labels)},
               {"static_frames", body.static_frames}};
  if (body.first_found) json["first_found_frame"] = *body.first_found;
  if (body.placement)
    json["pose_in_box"] = {{"frames", body.placement->frames},
                           {"inside_frames", body.placement->inside}};
  return json;
}

Json velocityJson(const VelocityScore& score) {
  Json json = {{"body", score.truth.body}, {"first_frame", score.first},
               {"last_frame", score.last}, {"vx_m_s", score.truth.vx},
               {"vz_m_s", score.truth.vz}, {"sd_m_s", score.truth.sd}};
  if (score.implied_depth) {
    json["implied_depth_m"] = score.implied_depth->z;
    json["implied_depth_sd_m"] = score.implied_depth->sd;
  }
  if (score.id < 1) return json;
  json["id"] = score.id;
  json["estimated_m_s"] = {score.velocity.x(), score.velocity.y(), score.velocity.z()};
  json["error_vx_m_s"] = score.errorX();
  json["error_vz_m_s"] = score.errorZ();
  json["displacement_error_m"] = score.displacement_error;
  json["depth_m"] = score.depth;
  return json;
}

// "" for none, ": 1, 2-4" for some.
std::string framesText(const std::vector<std::size_t>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t j = i;
    while (j + 1 < frames.size() && frames[j + 1] == frames[j] + 1) ++j;
    text += (text.empty() ? ": " : ", ") + std::to_string(frames[i]);
    if (j > i) text += '-' + std::to_string(frames[j]);
    i = j + 1;
  }
  return text;
}

void appendBoxedBody(std::string& text, const mvo::BoxedBody& body) {
  append(text,
         "boxed %-3s found in %d of %d clear frames (%.1f %%; %d without outliers), in %d of all "
         "%d, ids {%s}, %d switches; %.1f %% labelled 0",
         body.body.empty() ? "-" : body.body.c_str(), body.found_clear, body.clear_frames,
         body.foundClearPercent(), body.found_without_outliers, body.found, body.frames,
         listText(body.ids).c_str(), body.id_switches, body.labels.staticPercent());
  if (!body.static_frames.empty())
    text += ", most in " + std::to_string(body.static_frames.size()) + " frames" +
            framesText(body.static_frames);
  if (body.placement)
    append(text, "; pose in the box in %d of %d frames", body.placement->inside,
           body.placement->frames);
  text += '\n';
}

void appendVelocities(std::string& text, const std::vector<VelocityScore>& scores) {
  int found = 0;
  int deep = 0;
  double squares_x = 0;
  double squares_z = 0;
  double largest = 0;
  int near = 0;
  for (const VelocityScore& score : scores) {
    if (score.id < 1) continue;
    ++found;
    squares_x += score.errorX() * score.errorX();
    squares_z += score.errorZ() * score.errorZ();
    largest = std::max(largest, score.displacement_error);
    if (!score.implied_depth) continue;
    ++deep;
    if (std::abs(score.depth - score.implied_depth->z) <= 2 * score.implied_depth->sd) ++near;
  }
  append(text, "velocity known in %d of %zu stretches", found, scores.size());
  if (found > 0)
    append(text, ", off by %.2f m/s in x and %.2f in z (RMS), displacement by %.2f m at most",
           std::sqrt(squares_x / found), std::sqrt(squares_z / found), largest);
  if (deep > 0) append(text, "; depth within 2 sd of what boxes tell in %d of %d", near, deep);
  text += '\n';
}

}  // namespace

Json boxesJson(const mvo::BoxEvaluation& boxes) {
  Json json;
  json["box_label"] = {{"frames", boxes.own_label.frames},
                       {"labelled_frames", boxes.own_label.labelled},
                       {"pct", boxes.own_label.percent()}};
  Json& bodies = json["boxed_bodies"] = Json::array();
  for (const mvo::BoxedBody& body : boxes.bodies) bodies.push_back(boxedBodyJson(body));
  json["outside_boxes"] = {{"labels", sharesJson(boxes.background.labels)},
                           {"labelled_frames", boxes.background.frames},
                           {"not_static_frames", boxes.background.not_static_frames}};
  if (boxes.velocities.empty()) return json;
  Json& velocities = json["velocities"] = Json::array();
  for (const VelocityScore& score : boxes.velocities) velocities.push_back(velocityJson(score));
  return json;
}

std::string boxesText(const mvo::BoxEvaluation& boxes) {
  std::string text;
  if (boxes.own_label.frames > 0)
    append(text, "boxed body has its own label in %d of %d frames (%.1f %%)\n",
           boxes.own_label.labelled, boxes.own_label.frames, boxes.own_label.percent());
  for (const mvo::BoxedBody& body : boxes.bodies) appendBoxedBody(text, body);
  const mvo::BackgroundLabels& rest = boxes.background;
  append(text,
         "outside the boxes %.1f %% labelled 0 (%.1f %% outliers), most not in %zu of %d frames",
         rest.labels.staticPercent(), rest.labels.outlierPercent(), rest.not_static_frames.size(),
         rest.frames);
  text += framesText(rest.not_static_frames) + '\n';
  if (!boxes.velocities.empty()) appendVelocities(text, boxes.velocities);
  return text;
}

}  // namespace mvo_tools
