// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/run_writer.hpp"

#include <iomanip>

#include "io/covariances_csv.hpp"
#include "io/stamp.hpp"
#include "statistics.hpp"

namespace mvo_tools {

namespace {

constexpr char kTotal[] = "total";

// A problem without its figures, which differ from frame to frame.
std::string kindOf(const std::string& problem) { return problem.substr(0, problem.find(':')); }

}  // namespace

RunWriter::RunWriter(std::filesystem::path folder, Poses poses)
    : folder_(std::move(folder)), poses_(poses), labels_(folder_ / "labels.csv") {
  labels_.stream() << "stamp,tracklet_id,u,v,motion_id\n" << std::fixed << std::setprecision(3);
}

void RunWriter::add(const mvo::MultimotionEstimate& estimate,
                    const std::vector<std::pair<std::string, double>>& edge_timings_ms,
                    double total_ms) {
  ++frames_;
  for (const auto* timings : {&edge_timings_ms, &estimate.timings_ms})
    for (const auto& [stage, ms] : *timings)
      if (stage != kTotal) timings_.push_back({estimate.stamp_ns, stage, ms});
  timings_.push_back({estimate.stamp_ns, kTotal, total_ms});
  totals_ms_.push_back(total_ms);
  unestimated_labels_ += estimate.unestimated;
  if (!estimate.problem.empty()) ++problems_[kindOf(estimate.problem)];
  if (!estimate.notice.empty()) notices_[estimate.notice].push_back(estimate.frame);
  world_changes_ = estimate.world_changes;
  if (!estimate.valid) {
    last_problem_ = estimate.problem;
    return;
  }
  stamps_ns_[estimate.frame] = estimate.stamp_ns;
  if (!first_pose_) first_pose_ = {estimate.frame, estimate.T_world_camera};
  addPoses(estimate);
  addCovariances(estimate);
  const std::string stamp = mvo::formatStamp(estimate.stamp_ns);
  for (const mvo::LabeledPoint& point : estimate.points)
    labels_.stream() << stamp << ',' << point.tracklet << ',' << point.y.x() << ',' << point.y.y()
                     << ',' << point.id << '\n';
}

void RunWriter::addPoses(const mvo::MultimotionEstimate& estimate) {
  for (const mvo::MotionEstimate& motion : estimate.motions) {
    ++frames_of_[motion.id];
    if (motion.id == mvo::kStatic) {
      ++estimated_;
      if (frames_ > 1) ++estimated_after_first_;
    }
    if (poses_ == Poses::kCausal)
      T_world_motion_[{motion.id, estimate.frame}] = motion.T_world_motion;
  }
  if (poses_ == Poses::kSmoothed)
    for (const mvo::SmoothedPose& pose : estimate.smoothed)
      T_world_motion_[{pose.id, pose.frame}] = pose.T_world_motion;
}

void RunWriter::addCovariances(const mvo::MultimotionEstimate& estimate) {
  const auto add = [&](const mvo::MotionEstimate& motion, mvo::MotionSpan span, mvo::FrameId from,
                       const Eigen::Isometry3d& T_ck_from, const mvo::Matrix6d& covariance) {
    const auto stamp = stamps_ns_.find(from);
    if (stamp == stamps_ns_.end() || covariance.isZero(0)) return;  // lost there, or no batch yet
    covariances_.push_back(
        {estimate.stamp_ns, motion.id, span, stamp->second, T_ck_from, covariance});
  };
  for (const mvo::MotionEstimate& motion : estimate.motions) {
    if (motion.T_ckm1_motion)
      add(motion, mvo::MotionSpan::kStep, estimate.frame - 1,
          motion.T_ck_motion * motion.T_ckm1_motion->inverse(), motion.step_covariance);
    add(motion, mvo::MotionSpan::kWindow, motion.first_frame, motion.T_ck_c1, motion.covariance);
    if (motion.id == mvo::kStatic)
      add(motion, mvo::MotionSpan::kAll, first_pose_->first,
          motion.T_ck_motion * first_pose_->second, motion.pose_covariance);
  }
}

void RunWriter::finish() {
  std::map<mvo::LabelId, std::vector<mvo::StampedPose>> trajectories;
  trajectories[mvo::kStatic];  // there is always a camera.tum
  for (const auto& [key, T_world_motion] : T_world_motion_) {
    const auto stamp = stamps_ns_.find(key.second);
    if (stamp != stamps_ns_.end())
      trajectories[key.first].push_back({stamp->second, T_world_motion});
  }
  for (const auto& [id, poses] : trajectories)
    mvo::writeTum(folder_ / (id == mvo::kStatic ? std::string("camera.tum")
                                                : "motion_" + std::to_string(id) + ".tum"),
                  poses);
  labels_.commit();
  mvo::writeTimings(folder_ / "timing.csv", timings_);
  mvo::writeCovariances(folder_ / "covariances.csv", covariances_);
}

nlohmann::ordered_json RunWriter::summary() const {
  nlohmann::ordered_json out;
  out["frames"] = frames_;
  out["estimated"] = estimated_;
  out["without_estimate"] = frames_ - estimated_;
  out["labels_without_estimate"] = unestimated_labels_;
  auto& ids = out["frames_of_motion"] = nlohmann::ordered_json::object();
  for (const auto& [id, frames] : frames_of_) ids[std::to_string(id)] = frames;
  auto& problems = out["problems"] = nlohmann::ordered_json::object();
  for (const auto& [sentence, times] : problems_) problems[sentence] = times;
  out["world_changes"] = world_changes_;
  auto& notices = out["notices"] = nlohmann::ordered_json::object();
  for (const auto& [sentence, frames] : notices_) notices[sentence] = frames;
  out["step_ms"] = {{"median", mvo::quantile(totals_ms_, 0.5)},
                    {"p99", mvo::quantile(totals_ms_, 0.99)},
                    {"max", mvo::quantile(totals_ms_, 1.0)}};
  return out;
}

}  // namespace mvo_tools
