// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All figures of one run against the truth of its sequence. What the truth cannot tell is absent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mvo/eval/alignment.hpp"
#include "mvo/eval/body_states.hpp"
#include "mvo/eval/box_label.hpp"
#include "mvo/eval/errors.hpp"
#include "mvo/eval/motion_count.hpp"
#include "mvo/eval/segmentation.hpp"
#include "mvo/eval/stage_times.hpp"
#include "mvo/io/estimate.hpp"
#include "mvo/io/truth.hpp"

namespace mvo {

enum class CameraAlignment { kLeft, kLeftRight };

struct EvaluationOptions {
  CameraAlignment camera_alignment = CameraAlignment::kLeft;
};

/// The camera's figures.
struct CameraEvaluation {
  Alignment alignment;
  double path = 0;      ///< of the whole true trajectory [m]
  int estimated = 0;    ///< frames with an estimated pose
  double coverage = 0;  ///< of all frames [%]
  ErrorSummary errors;  ///< errors.rmse is the ATE
  StepSummary steps;    ///< RPE over consecutive frames
  std::optional<EndDrift> drift;
  std::vector<PoseError> curve;
};

/// Errors within one stretch in view.
struct StretchEvaluation {
  Stretch stretch;
  ErrorSummary errors;
  ErrorSummary visible_errors;  ///< the frames of it in which the body is visible
};

/// One body's figures.
struct BodyEvaluation {
  int body = 0;
  double path = 0;           ///< of the whole true trajectory [m]
  std::vector<int> ids;      ///< estimated motions on this body
  int estimated = 0;         ///< frames with an estimated pose
  int duplicate_frames = 0;  ///< with poses of several ids
  ErrorSummary errors;
  StepSummary steps;  ///< per-frame motion error
  std::vector<PoseError> curve;

  // With visibility.
  bool has_visibility = false;
  int required_frames = 0;      ///< visible and moving
  int visible_frames = 0;       ///< moving or not
  double coverage = 0;          ///< of the required frames [%]
  double coverage_visible = 0;  ///< of the visible frames [%]
  ErrorSummary visible_errors;
  StepSummary visible_steps;
  std::vector<StretchEvaluation> stretches;

  // With masks.
  bool has_masks = false;
  int id_switches = 0;
  double one_label = 0;  ///< share of one and the same id among its observations [%]
  ClassScore segmentation;
};

/// The figures of a run.
struct Evaluation {
  int frames = 0;
  std::optional<CameraEvaluation> camera;
  std::vector<BodyEvaluation> bodies;
  std::vector<MotionCount> counts;  ///< per frame; empty if the truth does not know the bodies
  RightNumberRates rates;
  std::optional<ClassScore> static_world;
  Association association;                ///< body (0: static world) by id
  std::optional<int> third_party_frames;  ///< with at least one tracklet of an id >= 1
  std::optional<BoxScore> boxes;
  std::vector<StageTime> times;
  std::vector<std::string> notes;  ///< what the reader should know before believing the figures
};

/// Law: an estimate that is the truth up to one transform of the world, and one of each body's
/// frame, has zero errors. Throws std::runtime_error if estimate and truth share no frame.
Evaluation evaluate(const Estimate& estimate, const Truth& truth,
                    const EvaluationOptions& options = {});

/// The truth of the frames between the first and the last that the estimate has seen.
Truth cropToEstimate(const Truth& truth, const Estimate& estimate);

}  // namespace mvo
