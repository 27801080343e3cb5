// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/errors.hpp"

#include <algorithm>
#include <cmath>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

PoseError poseError(std::size_t frame, const Vector3d& t, const Matrix3d& R, int id) {
  return {frame, t, rollPitchYaw(R), angle(R), id};
}

Vector3d largerByMagnitude(const Vector3d& a, const Vector3d& b) {
  return (a.array().abs() >= b.array().abs()).select(a, b);
}

// Calls with (frame, P_k-1, P_k, G_k-1, G_k) for all consecutive frames that have all four poses of
// one id, and collects the answers.
template <typename Function>
std::vector<StepError> forEachStep(const AlignedTrack& track, const FramePoses& truth,
                                   const Function& error) {
  std::vector<StepError> errors;
  for (std::size_t k = 1; k < track.size() && k < truth.size(); ++k) {
    if (!track[k - 1] || !track[k] || !truth[k - 1] || !truth[k]) continue;
    if (track[k - 1]->id != track[k]->id) continue;
    StepError step =
        error(track[k - 1]->T_world_body, track[k]->T_world_body, *truth[k - 1], *truth[k]);
    step.frame = k;
    errors.push_back(step);
  }
  return errors;
}

}  // namespace

Vector3d rollPitchYaw(const Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(1, 0), R(0, 0))};
}

std::vector<PoseError> cameraErrors(const AlignedTrack& track, const FramePoses& truth) {
  std::vector<PoseError> errors;
  for (std::size_t k = 0; k < track.size() && k < truth.size(); ++k) {
    if (!track[k] || !truth[k]) continue;
    const Isometry3d E = truth[k]->inverse() * track[k]->T_world_body;
    errors.push_back(poseError(k, E.translation(), E.linear(), track[k]->id));
  }
  return errors;
}

std::vector<PoseError> bodyErrors(const AlignedTrack& track, const FramePoses& truth) {
  std::vector<PoseError> errors;
  for (std::size_t k = 0; k < track.size() && k < truth.size(); ++k) {
    if (!track[k] || !truth[k]) continue;
    const Isometry3d& P = track[k]->T_world_body;
    errors.push_back(poseError(k, P.translation() - truth[k]->translation(),
                               P.linear() * truth[k]->linear().transpose(), track[k]->id));
  }
  return errors;
}

ErrorSummary summarize(const std::vector<PoseError>& errors, double path_length) {
  ErrorSummary summary;
  if (errors.empty()) return summary;
  summary.frames = static_cast<int>(errors.size());
  Vector3d rpy_squares = Vector3d::Zero();
  double squares = 0;
  double angle_squares = 0;
  summary.max_frame = errors.front().frame;
  for (const PoseError& error : errors) {
    const double norm = error.translation.norm();
    if (norm > summary.max) {
      summary.max = norm;
      summary.max_frame = error.frame;
    }
    summary.max_angle = std::max(summary.max_angle, error.angle);
    summary.signed_max = largerByMagnitude(summary.signed_max, error.translation);
    summary.signed_max_rpy = largerByMagnitude(summary.signed_max_rpy, error.roll_pitch_yaw);
    squares += norm * norm;
    angle_squares += error.angle * error.angle;
    rpy_squares += error.roll_pitch_yaw.cwiseAbs2();
  }
  const double n = static_cast<double>(errors.size());
  summary.rmse = std::sqrt(squares / n);
  summary.rmse_angle = std::sqrt(angle_squares / n);
  summary.rmse_rpy = (rpy_squares / n).cwiseSqrt();
  if (path_length > 0) {
    summary.max_percent = 100 * summary.max / path_length;
    summary.rmse_percent = 100 * summary.rmse / path_length;
  }
  return summary;
}

std::vector<PoseError> restrictTo(const std::vector<PoseError>& errors,
                                  const std::vector<bool>& keep) {
  std::vector<PoseError> kept;
  for (const PoseError& error : errors)
    if (error.frame < keep.size() && keep[error.frame]) kept.push_back(error);
  return kept;
}

std::vector<StepError> cameraStepErrors(const AlignedTrack& track, const FramePoses& truth) {
  return forEachStep(
      track, truth,
      [](const Isometry3d& Pa, const Isometry3d& Pb, const Isometry3d& Ga, const Isometry3d& Gb) {
        const Isometry3d E = (Ga.inverse() * Gb).inverse() * (Pa.inverse() * Pb);
        return StepError{0, E.translation().norm(), angle(E.linear())};
      });
}

std::vector<StepError> bodyStepErrors(const AlignedTrack& track, const FramePoses& truth) {
  return forEachStep(
      track, truth,
      [](const Isometry3d& Pa, const Isometry3d& Pb, const Isometry3d& Ga, const Isometry3d& Gb) {
        const Vector3d moved_estimate = Pb.translation() - Pa.translation();
        const Vector3d moved_truth = Gb.translation() - Ga.translation();
        const Matrix3d turned_estimate = Pb.linear() * Pa.linear().transpose();
        const Matrix3d turned_truth = Gb.linear() * Ga.linear().transpose();
        return StepError{0, (moved_estimate - moved_truth).norm(),
                         angle(turned_estimate * turned_truth.transpose())};
      });
}

StepSummary summarize(const std::vector<StepError>& errors) {
  StepSummary summary;
  if (errors.empty()) return summary;
  summary.steps = static_cast<int>(errors.size());
  summary.max_frame = summary.max_angle_frame = errors.front().frame;
  for (const StepError& error : errors) {
    summary.rmse += error.translation * error.translation;
    summary.rmse_angle += error.angle * error.angle;
    if (error.translation > summary.max) {
      summary.max = error.translation;
      summary.max_frame = error.frame;
    }
    if (error.angle > summary.max_angle) {
      summary.max_angle = error.angle;
      summary.max_angle_frame = error.frame;
    }
  }
  summary.rmse = std::sqrt(summary.rmse / static_cast<double>(errors.size()));
  summary.rmse_angle = std::sqrt(summary.rmse_angle / static_cast<double>(errors.size()));
  return summary;
}

std::optional<double> pathScale(const AlignedTrack& track, const FramePoses& truth) {
  FramePoses estimated;
  FramePoses real;
  for (std::size_t k = 0; k < track.size() && k < truth.size(); ++k) {
    if (!track[k] || !truth[k]) continue;
    estimated.emplace_back(track[k]->T_world_body);
    real.push_back(truth[k]);
  }
  const double path = pathLength(real);
  if (path <= 0) return {};
  return pathLength(estimated) / path;
}

std::optional<EndDrift> endDrift(const FramePoses& estimate, const FramePoses& truth) {
  EndDrift drift;
  int common = 0;
  for (std::size_t k = 0; k < estimate.size() && k < truth.size(); ++k) {
    if (!estimate[k] || !truth[k]) continue;
    if (common++ == 0) drift.first_frame = k;
    drift.last_frame = k;
  }
  if (common < 2) return {};
  const std::size_t first = drift.first_frame;
  const std::size_t last = drift.last_frame;
  const Isometry3d P = estimate[first]->inverse() * *estimate[last];
  const Isometry3d G = truth[first]->inverse() * *truth[last];
  const Isometry3d E = G.inverse() * P;
  drift.path = pathLength(FramePoses(truth.begin() + static_cast<std::ptrdiff_t>(first),
                                     truth.begin() + static_cast<std::ptrdiff_t>(last) + 1));
  drift.translation = E.translation().norm();
  drift.angle = angle(E.linear());
  if (drift.path > 0) {
    drift.percent = 100 * drift.translation / drift.path;
    drift.angle_per_metre = drift.angle / drift.path;
  }
  return drift;
}

}  // namespace mvo
