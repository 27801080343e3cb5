// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/camera_errors_summary.hpp"

namespace mvo_tools {

namespace {

nlohmann::ordered_json figure(const mvo::Measured& m) {
  return {{"value", m.value}, {"sd", m.deviation}};
}

}  // namespace

nlohmann::ordered_json cameraErrorsSummary(const mvo::CameraErrorReport& report) {
  nlohmann::ordered_json out;
  out["significant"] = report.significant;
  out["advice"] = report.advice;
  out["disparity_px"] = figure(report.disparity);
  out["disparity_rms_px"] = figure(report.disparity_rms);
  out["rows_px"] = figure(report.rows);
  out["rows_rms_px"] = figure(report.rows_rms);
  out["yaw_deg"] = figure(report.yaw);
  out["pitch_deg"] = figure(report.pitch);
  out["roll_deg"] = figure(report.roll);
  out["focal_percent"] = figure(report.focal);
  out["delay_ms"] = figure(report.delay);
  out["rest_rms_px"] = figure(report.rest_rms);
  auto& terms = out["terms"] = nlohmann::ordered_json::object();
  for (const mvo::CameraErrorTerm& term : report.terms) {
    terms[term.name] = figure(term.measured);
    terms[term.name]["unit"] = term.unit;
  }
  return out;
}

}  // namespace mvo_tools
