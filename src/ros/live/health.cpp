// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/health.hpp"

namespace mvo_ros {

namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kLargeError = 0.5;  // of the camera, that is warned of although corrected [px]

}  // namespace

void Health::step(const Step& step, double latency, double since_arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++frames_;
  ++recent_.steps;
  latency_ = latency;
  since_arrival_ = since_arrival;
  step_ms_ = step.total_ms;
  tracklets_ = step.estimate.points.size();
  motions_ = step.estimate.motions.size();
  camera_errors_ = step.camera_errors;
  resets_ = step.resets;
  world_changes_ = step.estimate.world_changes;
  notice_ = step.notice;
  silence_.clear();
  blockage_.clear();
  lost_ = !step.estimate.valid;
  if (lost_) {
    ++recent_.lost;
    last_error_ = step.estimate.problem;
  } else if (!step.notice.empty()) {
    last_error_ = step.notice;
  }
  if (step.estimate.cut_short.any()) {
    ++recent_.cut_short;
    cut_short_ = step.estimate.cut_short.text();
  }
  stages_ms_ = step.estimate.timings_ms;
  stages_ms_.insert(stages_ms_.begin(), {"decode", step.decode_ms});
  if (step.period && step.total_ms > 1e3 * *step.period) {
    ++recent_.overrun;
    if (step.total_ms > recent_.worst_ms) {
      recent_.worst_ms = step.total_ms;
      double longest = 0;
      for (const auto& [stage, ms] : stages_ms_)
        if (stage != "total" && ms > longest) {
          longest = ms;
          recent_.slowest = stage;
        }
    }
  }
}

void Health::load(int features, int wanted, double limit_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  features_ = features;
  features_wanted_ = wanted;
  limit_ms_ = limit_ms;
}

void Health::refused(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++frames_refused_;
  ++recent_.refused;
  last_error_ = problem;
}

void Health::blocked(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  blockage_ = problem;
  last_error_ = problem;
}

void Health::paused(bool is) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = is;
}

void Health::dropped(std::uint64_t count) {
  const std::lock_guard<std::mutex> lock(mutex_);
  dropped_ = count;
}

void Health::silent(const std::string& report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  silence_ = report;
  if (!report.empty()) last_error_ = report;
}

std::string Health::sacrifices() const {
  std::string out;
  if (features_ < features_wanted_)
    out = "shedding: " + std::to_string(features_) + " of " + std::to_string(features_wanted_) +
          " features";
  if (recent_.cut_short > 0)
    out += (out.empty() ? "" : "; ") + std::to_string(recent_.cut_short) + " of " +
           std::to_string(recent_.steps) + " steps cut short by the time budget: " + cut_short_;
  return out;
}

void Health::reportCameraErrors(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  if (!camera_errors_) {
    status.add("camera errors", "not learnt");
    return;
  }
  const auto add = [&status](const char* name, const mvo::Measured& m, const char* unit) {
    status.addf(std::string("camera ") + name, "%.3f +- %.3f %s", m.value, m.deviation, unit);
  };
  status.add("camera errors",
             camera_errors_->significant ? camera_errors_->advice : "none that is significant");
  add("disparity error", camera_errors_->disparity, "px");
  add("disparity error, rms", camera_errors_->disparity_rms, "px");
  add("row error", camera_errors_->rows, "px");
  add("row error, rms", camera_errors_->rows_rms, "px");
  add("yaw outwards", camera_errors_->yaw, "deg");
  add("pitch upwards", camera_errors_->pitch, "deg");
  add("roll clockwise", camera_errors_->roll, "deg");
  add("focal length longer", camera_errors_->focal, "%");
  add("delay", camera_errors_->delay, "ms");
}

void Health::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::string sacrificed = sacrifices();
  if (recent_.refused > 0)
    status.summary(DiagnosticStatus::ERROR, last_error_);
  else if (!blockage_.empty())
    status.summary(DiagnosticStatus::ERROR, blockage_);
  else if (paused_)
    status.summary(DiagnosticStatus::WARN, "paused");
  else if (!silence_.empty())
    status.summary(DiagnosticStatus::WARN, silence_);
  else if (lost_)
    status.summary(DiagnosticStatus::WARN, "lost: " + last_error_);
  else if (resets_ != resets_reported_ || world_changes_ > world_changes_reported_ ||
           !notice_.empty())
    status.summary(DiagnosticStatus::WARN, notice_.empty() ? last_error_ : notice_);
  else if (recent_.overrun > 0)
    status.summaryf(
        DiagnosticStatus::WARN,
        "%d of %d steps took longer than the frame period, the longest %.0f ms, most of "
        "it in stage %s%s",
        recent_.overrun, recent_.steps, recent_.worst_ms, recent_.slowest.c_str(),
        sacrificed.empty() ? "" : ("; " + sacrificed).c_str());
  else if (!sacrificed.empty())
    status.summary(DiagnosticStatus::WARN, sacrificed);
  else if (frames_ == 0)
    status.summary(DiagnosticStatus::OK, "waiting for the first frame");
  else if (camera_errors_ && camera_errors_->significant)
    status.summary(
        camera_errors_->largest() > kLargeError ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
        camera_errors_->advice);
  else
    status.summary(DiagnosticStatus::OK, "ok");
}

void Health::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::WallTime now = ros::WallTime::now();
  const double seconds = (now - since_).toSec();
  summarize(status);
  status.addf("rate", "%.2f Hz", seconds > 0 ? recent_.steps / seconds : 0.0);
  status.addf("latency", "%.1f ms from stamp to output", 1e3 * latency_);
  status.addf("in the node", "%.1f ms from arrival to output", 1e3 * since_arrival_);
  status.add("frames", frames_);
  status.add("frames dropped", dropped_);
  status.add("frames dropped since last report", dropped_ - dropped_reported_);
  status.add("frames refused", frames_refused_);
  status.add("state", frames_ == 0 ? "waiting" : lost_ ? "lost" : "ok");
  status.add("resets", resets_);
  status.add("changes of the static world's motion", world_changes_);
  status.add("tracklets", tracklets_);
  status.add("motions", motions_);
  status.addf("features in force", "%d of %d", features_, features_wanted_);
  status.addf("time limit", limit_ms_ > 0 ? "%.0f ms" : "none", limit_ms_);
  status.add("steps cut short since last report", recent_.cut_short);
  status.addf("step", "%.1f ms", step_ms_);
  for (const auto& [stage, ms] : stages_ms_)
    if (stage != "total") status.addf("stage " + stage, "%.2f ms", ms);
  reportCameraErrors(status);
  status.add("last error", last_error_.empty() ? "none" : last_error_);

  recent_ = {};
  since_ = now;
  dropped_reported_ = dropped_;
  resets_reported_ = resets_;
  world_changes_reported_ = world_changes_;
}

}  // namespace mvo_ros
