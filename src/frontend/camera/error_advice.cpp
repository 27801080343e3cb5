// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/error_advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace mvo {

namespace {

constexpr double kSure = 5;               // standard deviations
constexpr double kLeastPixels = 0.1;      // that matter: the noise of a tracked point
constexpr double kLeastDelay = 1;         // that matters [ms]: as much, at 100 px/s
constexpr double kLeastDeviation = 0.01;  // that is written
constexpr double kRadians = 3.14159265358979323846 / 180;

// `pixels` is what one unit of the value moves in the image.
bool matters(const Measured& m, double pixels = 1) {
  return std::abs(m.value) * pixels > kLeastPixels && std::abs(m.value) > kSure * m.deviation;
}

std::string text(double value, int decimals, const char* unit) {
  char out[64];
  std::snprintf(out, sizeof out, "%.*f%s", decimals, std::abs(value), unit);
  return out;
}

// "1.1 ± 0.1 px"
std::string text(const Measured& m, const char* unit) {
  const double deviation = std::max(m.deviation, kLeastDeviation);
  const int decimals = deviation < 0.095 ? 2 : 1;
  return text(m.value, decimals, " ± ") + text(deviation, decimals, unit);
}

// "a", "a and b", "a, b and c"
std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) out += i + 1 == parts.size() ? " and " : ", ";
    out += parts[i];
  }
  return out;
}

// "looks 0.08° outwards of what its calibration says", "has a focal length 0.30 % longer", ...
std::vector<std::string> differences(const CameraErrorReport& r) {
  const StereoCamera& camera = r.learnt.camera;
  const double radius = std::hypot(camera.width, camera.height) / std::sqrt(12.0);  // rms [px]
  std::vector<std::string> directions;
  if (matters(r.yaw, camera.fu * kRadians))
    directions.push_back(text(r.yaw.value, 2, r.yaw.value > 0 ? "° outwards" : "° inwards"));
  if (matters(r.pitch, camera.fv * kRadians))
    directions.push_back(text(r.pitch.value, 2, r.pitch.value > 0 ? "° upwards" : "° downwards"));
  std::vector<std::string> all;
  if (!directions.empty())
    all.push_back("looks " + joined(directions) + " of what its calibration says");
  if (matters(r.roll, radius * kRadians))
    all.push_back("is rolled by " +
                  text(r.roll.value, 2, r.roll.value > 0 ? "° clockwise" : "° anticlockwise"));
  if (matters(r.focal, 0.01 * radius))
    all.push_back("has a focal length " +
                  text(r.focal.value, 2, r.focal.value > 0 ? " % longer" : " % shorter"));
  if (all.empty() || matters(r.rest_rms))
    all.push_back("differs in principal point or distortion by " + text(r.rest_rms, " px rms"));
  return all;
}

// "disparities are 1.1 ± 0.1 px too small", "rows differ by 0.31 ± 0.02 px rms"
std::vector<std::string> effects(const CameraErrorReport& r) {
  std::vector<std::string> all;
  if (matters(r.disparity))
    all.push_back("disparities are " + text(r.disparity, " px") +
                  (r.disparity.value > 0 ? " too large" : " too small"));
  else if (matters(r.disparity_rms))
    all.push_back("disparities are off by " + text(r.disparity_rms, " px rms"));
  if (matters(r.rows))
    all.push_back("rows differ by " + text(r.rows, " px"));
  else if (matters(r.rows_rms))
    all.push_back("rows differ by " + text(r.rows_rms, " px rms"));
  return all;
}

}  // namespace

std::string errorAdvice(const CameraErrorReport& report) {
  const std::vector<std::string> visible = effects(report);
  const bool late = std::abs(report.delay.value) > kLeastDelay &&
                    std::abs(report.delay.value) > kSure * report.delay.deviation;
  if (visible.empty() && !late) return "";
  std::vector<std::string> what;
  if (!visible.empty()) what = differences(report);
  if (late)
    what.push_back("sees " + text(report.delay, " ms") +
                   (report.delay.value > 0 ? " later" : " earlier") + " than the left");
  std::string out = "the right camera " + joined(what);
  if (!visible.empty()) out += ": " + joined(visible);
  out += "; corrected";
  if (!visible.empty()) out += "; calibrate again";
  if (late) out += "; trigger both cameras together";
  return out;
}

}  // namespace mvo
