// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluation_report.hpp"

#include <cmath>
#include <vector>

#include "eval/motion_count.hpp"
#include "tools/boxes_report.hpp"
#include "tools/report_text.hpp"

namespace mvo_tools {

namespace {

using Json = nlohmann::ordered_json;
using mvo::BodyEvaluation;
using mvo::CameraEvaluation;
using mvo::ErrorSummary;
using mvo::Evaluation;
using mvo::MotionCount;
using mvo::PoseError;
using mvo::StepSummary;

double degrees(double radians) { return radians * 180 / M_PI; }

Json vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json degreesOf(const Eigen::Vector3d& v) { return vector(v * (180 / M_PI)); }

Json pose(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return {{"t", vector(T.translation())}, {"q_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json errorsJson(const ErrorSummary& errors) {
  return {{"frames", errors.frames},
          {"max_m", errors.max},
          {"max_pct", errors.max_percent},
          {"max_frame", errors.max_frame},
          {"rmse_m", errors.rmse},
          {"rmse_pct", errors.rmse_percent},
          {"signed_max_m", vector(errors.signed_max)},
          {"max_deg", degrees(errors.max_angle)},
          {"rmse_deg", degrees(errors.rmse_angle)},
          {"signed_max_rpy_deg", degreesOf(errors.signed_max_rpy)},
          {"rmse_rpy_deg", degreesOf(errors.rmse_rpy)}};
}

Json stepsJson(const StepSummary& steps) {
  return {{"steps", steps.steps},
          {"rmse_m", steps.rmse},
          {"max_m", steps.max},
          {"rmse_deg", degrees(steps.rmse_angle)},
          {"max_deg", degrees(steps.max_angle)},
          {"max_frame", steps.max_frame},
          {"max_deg_frame", steps.max_angle_frame}};
}

Json neesJson(const mvo::Nees& nees) {
  return {{"samples", nees.samples},
          {"mean", nees.mean},
          {"low_95", nees.low},
          {"high_95", nees.high},
          {"beyond_99_pct", nees.samples > 0 ? 100.0 * nees.beyond / nees.samples : 0.0}};
}

Json consistencyJson(const mvo::Consistency& consistency) {
  Json json = {{"step", neesJson(consistency.step)}, {"window", neesJson(consistency.window)}};
  if (consistency.all.empty()) return json;
  Json& all = json["all"] = {{"frame", Json::array()}, {"nees", Json::array()}};
  for (const mvo::FrameNees& at : consistency.all) {
    all["frame"].push_back(at.frame);
    all["nees"].push_back(at.nees);
  }
  return json;
}

Json scoreJson(const mvo::ClassScore& score) {
  return {{"true_positives", score.true_positives},
          {"false_positives", score.false_positives},
          {"false_negatives", score.false_negatives},
          {"outliers", score.outliers},
          {"precision_pct", score.precision()},
          {"recall_pct", score.recall()},
          {"recall_without_outliers_pct", score.recallWithoutOutliers()}};
}

Json curveJson(const std::vector<PoseError>& curve) {
  Json json = {{"frame", Json::array()},
               {"id", Json::array()},
               {"xyz_m", Json::array()},
               {"rpy_deg", Json::array()}};
  for (const PoseError& error : curve) {
    json["frame"].push_back(error.frame);
    json["id"].push_back(error.id);
    json["xyz_m"].push_back(vector(error.translation));
    json["rpy_deg"].push_back(degreesOf(error.roll_pitch_yaw));
  }
  return json;
}

Json cameraJson(const CameraEvaluation& camera) {
  Json json = {{"path_m", camera.path},
               {"estimated_frames", camera.estimated},
               {"coverage_pct", camera.coverage},
               {"ate_m", camera.errors.rmse},
               {"errors", errorsJson(camera.errors)},
               {"rpe", stepsJson(camera.steps)},
               {"alignment", {{"A", pose(camera.alignment.A)}, {"B", pose(camera.alignment.B)}}}};
  if (camera.consistency.step.samples > 0)
    json["consistency"] = consistencyJson(camera.consistency);
  if (camera.scale) json["scale"] = *camera.scale;
  if (camera.drift)
    json["end_drift"] = {{"first_frame", camera.drift->first_frame},
                         {"last_frame", camera.drift->last_frame},
                         {"path_m", camera.drift->path},
                         {"m", camera.drift->translation},
                         {"pct", camera.drift->percent},
                         {"deg", degrees(camera.drift->angle)},
                         {"deg_per_m", degrees(camera.drift->angle_per_metre)}};
  return json;
}

Json bodyJson(const BodyEvaluation& body) {
  Json json = {{"body", body.body},
               {"path_m", body.path},
               {"ids", body.ids},
               {"estimated_frames", body.estimated},
               {"duplicate_frames", body.duplicate_frames},
               {"errors", errorsJson(body.errors)},
               {"per_frame", stepsJson(body.steps)}};
  if (body.consistency.step.samples > 0) json["consistency"] = consistencyJson(body.consistency);
  if (body.has_visibility) {
    json["required_frames"] = body.required_frames;
    json["visible_frames"] = body.visible_frames;
    json["coverage_pct"] = body.coverage;
    json["coverage_visible_pct"] = body.coverage_visible;
    json["errors_visible"] = errorsJson(body.visible_errors);
    json["per_frame_visible"] = stepsJson(body.visible_steps);
    json["stretches"] = Json::array();
    for (const auto& stretch : body.stretches)
      json["stretches"].push_back({{"first_frame", stretch.stretch.first},
                                   {"last_frame", stretch.stretch.last},
                                   {"errors", errorsJson(stretch.errors)},
                                   {"errors_visible", errorsJson(stretch.visible_errors)}});
  }
  if (body.has_masks) {
    json["id_switches"] = body.id_switches;
    json["one_label_pct"] = body.one_label;
    json["segmentation"] = scoreJson(body.segmentation);
  }
  return json;
}

Json countJson(const Evaluation& evaluation) {
  Json histogram = Json::object();
  for (const auto& [found, frames] : mvo::histogram(evaluation.counts))
    histogram[std::to_string(found)] = frames;
  const auto& rates = evaluation.rates;
  return {{"frames", rates.frames},
          {"right_number_pct", rates.all},
          {"right_number_after_first_3_pct", rates.after_first_3},
          {"right_number_labelled_frames_pct", rates.labelled},
          {"exact_set_pct", rates.exact_set},
          {"exact_set_after_first_3_pct", rates.exact_set_after_first_3},
          {"exact_set_labelled_frames_pct", rates.exact_set_labelled},
          {"histogram", histogram}};
}

Json curvesJson(const Evaluation& evaluation) {
  Json curves = Json::object();
  if (evaluation.camera) curves["camera"] = curveJson(evaluation.camera->curve);
  if (!evaluation.bodies.empty()) curves["bodies"] = Json::object();
  for (const BodyEvaluation& body : evaluation.bodies)
    curves["bodies"][std::to_string(body.body)] = curveJson(body.curve);
  if (evaluation.counts.empty()) return curves;
  Json& counts = curves["motion_count"] = {
      {"found", Json::array()}, {"least", Json::array()}, {"most", Json::array()}};
  for (const MotionCount& count : evaluation.counts) {
    counts["found"].push_back(count.found);
    counts["least"].push_back(count.least);
    counts["most"].push_back(count.most);
  }
  return curves;
}

void appendErrors(std::string& text, const ErrorSummary& errors, const StepSummary& steps) {
  append(text, "max %.4f m (%.3f %%), RMSE %.4f m, max %.3f deg, RMSE %.3f deg\n", errors.max,
         errors.max_percent, errors.rmse, degrees(errors.max_angle), degrees(errors.rmse_angle));
  append(text,
         "    signed max  x %+.4f  y %+.4f  z %+.4f m   roll %+.3f  pitch %+.3f  yaw %+.3f deg\n",
         errors.signed_max.x(), errors.signed_max.y(), errors.signed_max.z(),
         degrees(errors.signed_max_rpy.x()), degrees(errors.signed_max_rpy.y()),
         degrees(errors.signed_max_rpy.z()));
  append(text, "    per frame   %.2f mm, %.4f deg (RMS of %d steps)\n", 1000 * steps.rmse,
         degrees(steps.rmse_angle), steps.steps);
  if (steps.steps > 0)
    append(text, "    worst step  %.4f m in frame %zu, %.3f deg in frame %zu\n", steps.max,
           steps.max_frame, degrees(steps.max_angle), steps.max_angle_frame);
}

void appendNees(std::string& text, const char* of, const mvo::Nees& nees) {
  if (nees.samples > 0)
    append(text,
           "    NEES        %-6s %8.2f per degree of freedom, true: %.2f-%.2f (95 %% of %d "
           "samples), %d beyond 99 %%\n",
           of, nees.mean, nees.low, nees.high, nees.samples, nees.beyond);
}

void appendConsistency(std::string& text, const mvo::Consistency& consistency) {
  appendNees(text, "step", consistency.step);
  appendNees(text, "window", consistency.window);
  if (!consistency.all.empty())
    append(text, "    NEES        all    %8.2f since the first frame, in frame %zu\n",
           consistency.all.back().nees, consistency.all.back().frame);
}

void appendCamera(std::string& text, const CameraEvaluation& camera) {
  append(text, "camera   %d frames (%.1f %%), path %.3f m\n    error       ", camera.estimated,
         camera.coverage, camera.path);
  appendErrors(text, camera.errors, camera.steps);
  if (camera.scale) append(text, "    scale       %.4f of the true path\n", *camera.scale);
  if (camera.drift)
    append(text, "    end drift   %.4f m (%.3f %% of %.2f m), %.3f deg (%.4f deg/m)\n",
           camera.drift->translation, camera.drift->percent, camera.drift->path,
           degrees(camera.drift->angle), degrees(camera.drift->angle_per_metre));
  appendConsistency(text, camera.consistency);
}

void appendStretches(std::string& text, const BodyEvaluation& body) {
  if (body.stretches.size() < 2) return;
  for (const auto& stretch : body.stretches)
    append(text,
           "    in view     frames %zu-%zu: max %.4f m, %.3f deg (visible: %.4f m) over %d poses\n",
           stretch.stretch.first, stretch.stretch.last, stretch.errors.max,
           degrees(stretch.errors.max_angle), stretch.visible_errors.max, stretch.errors.frames);
}

void appendBody(std::string& text, const BodyEvaluation& body) {
  append(text, "body %-3d path %.3f m, ids {%s}, %d poses", body.body, body.path,
         listText(body.ids).c_str(), body.estimated);
  if (body.duplicate_frames > 0)
    append(text, ", %d frames with several ids", body.duplicate_frames);
  text += '\n';
  if (body.estimated > 0) {
    text += "    error       ";
    appendErrors(text, body.errors, body.steps);
  }
  appendConsistency(text, body.consistency);
  if (body.has_visibility) {
    if (body.visible_errors.frames > 0)
      append(text, "    visible     max %.4f m, %.3f deg; per frame %.2f mm, %.4f deg\n",
             body.visible_errors.max, degrees(body.visible_errors.max_angle),
             1000 * body.visible_steps.rmse, degrees(body.visible_steps.rmse_angle));
    append(text, "    coverage    %.1f %% of %d required, %.1f %% of %d visible frames\n",
           body.coverage, body.required_frames, body.coverage_visible, body.visible_frames);
    appendStretches(text, body);
  }
  if (body.has_masks)
    append(
        text,
        "    labels      precision %.1f %%, recall %.1f %% (%.1f %% without outliers), one label "
        "on %.1f %%, %d id switches\n",
        body.segmentation.precision(), body.segmentation.recall(),
        body.segmentation.recallWithoutOutliers(), body.one_label, body.id_switches);
}

void appendCounts(std::string& text, const Evaluation& evaluation) {
  const auto& rates = evaluation.rates;
  append(text,
         "motions  right number in %.1f %% of %d frames (%.1f %% after the first 3, %.1f %% of "
         "labelled ones)\n",
         rates.all, rates.frames, rates.after_first_3, rates.labelled);
  append(text, "    exact set   %.1f %% (%.1f %% after the first 3)\n    histogram  ",
         rates.exact_set, rates.exact_set_after_first_3);
  for (const auto& [found, frames] : mvo::histogram(evaluation.counts))
    append(text, " %d: %d", found, frames);
  text += '\n';
}

}  // namespace

Json toJson(const Evaluation& evaluation) {
  Json json = {{"frames", evaluation.frames}};
  if (evaluation.camera) json["camera"] = cameraJson(*evaluation.camera);
  if (!evaluation.counts.empty()) json["motion_count"] = countJson(evaluation);
  if (!evaluation.bodies.empty()) json["bodies"] = Json::array();
  for (const BodyEvaluation& body : evaluation.bodies) json["bodies"].push_back(bodyJson(body));
  if (evaluation.static_world)
    json["static_world"] = {{"segmentation", scoreJson(*evaluation.static_world)}};
  if (evaluation.association.size() > 1) {
    Json& association = json["body_of_id"] = Json::object();
    for (const auto& [id, body] : evaluation.association) association[std::to_string(id)] = body;
  }
  if (evaluation.third_party_frames)
    json["third_party_motion"] = {
        {"frames", *evaluation.third_party_frames},
        {"pct", 100.0 * *evaluation.third_party_frames / evaluation.frames}};
  if (evaluation.boxes) json.update(boxesJson(*evaluation.boxes));
  if (!evaluation.times.empty()) json["timing_ms"] = Json::object();
  for (const auto& time : evaluation.times)
    json["timing_ms"][time.stage] = {{"frames", time.frames},
                                     {"median", time.median},
                                     {"mean", time.mean},
                                     {"p95", time.p95},
                                     {"max", time.max}};
  json["notes"] = evaluation.notes;
  json["curves"] = curvesJson(evaluation);
  return json;
}

std::string toTable(const Evaluation& evaluation) {
  std::string text;
  append(text, "frames   %d\n", evaluation.frames);
  if (evaluation.camera) appendCamera(text, *evaluation.camera);
  if (!evaluation.counts.empty()) appendCounts(text, evaluation);
  for (const BodyEvaluation& body : evaluation.bodies) appendBody(text, body);
  if (evaluation.static_world)
    append(text, "static   labels: precision %.1f %%, recall %.1f %% (%.1f %% without outliers)\n",
           evaluation.static_world->precision(), evaluation.static_world->recall(),
           evaluation.static_world->recallWithoutOutliers());
  if (evaluation.third_party_frames)
    append(text, "third-party motions in %d of %d frames (%.1f %%)\n",
           *evaluation.third_party_frames, evaluation.frames,
           100.0 * *evaluation.third_party_frames / evaluation.frames);
  if (evaluation.boxes) text += boxesText(*evaluation.boxes);
  for (const auto& time : evaluation.times)
    append(text, "time     %-20s median %8.2f ms   mean %8.2f   95 %% %8.2f   max %8.2f\n",
           time.stage.c_str(), time.median, time.mean, time.p95, time.max);
  for (const std::string& note : evaluation.notes) text += "note: " + note + '\n';
  return text;
}

}  // namespace mvo_tools
