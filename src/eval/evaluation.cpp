// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/evaluation.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "eval/alignment.hpp"
#include "eval/body_states.hpp"
#include "eval/body_track.hpp"
#include "eval/box_labels.hpp"
#include "eval/box_motions.hpp"
#include "eval/consistency.hpp"
#include "eval/errors.hpp"
#include "eval/frames.hpp"
#include "eval/masked_points.hpp"
#include "eval/motion_count.hpp"
#include "eval/segmentation.hpp"
#include "eval/stage_times.hpp"
#include "io/frame_clock.hpp"

namespace mvo {

namespace {

// The default alignment is doubted if it leaves this much and the other one much less.
constexpr double kDoubtfulMisfit = 0.03;  // [m and rad]
constexpr double kClearlyBetter = 0.25;
constexpr std::size_t kBirth = 3;  // frames before the first labels

/// Everything by frame: what all the scores start from.
struct Table {
  FrameClock clock;
  FramePoses camera;
  FramePoses true_camera;
  MotionPoses motions;
  std::map<int, FramePoses> bodies;
  std::vector<std::vector<LabelRow>> labels;
  std::vector<FrameIds> ids;
  Supports supports;
  MaskedFrames points;  ///< empty without masks
  bool has_visibility = false;
  BodyStates states;  ///< empty without visibility
};

void addVisibility(const Truth& truth, Table& table) {
  std::map<int, std::vector<BodyVisibility>> shares;
  for (const auto& [body, poses] : table.bodies) shares[body].resize(table.clock.frames());
  for (const BodyVisibility& row : truth.visibility) {
    const auto frame = table.clock.frameOf(row.stamp_ns);
    const auto body = shares.find(row.body);
    if (frame && body != shares.end()) body->second[*frame] = row;
  }
  for (const auto& [body, poses] : table.bodies)
    table.states[body] = bodyStates(poses, shares[body]);
}

Table makeTable(const Estimate& estimate, const Truth& truth) {
  Table table{FrameClock(truth.stamps_ns), {}, {}, {}, {}, {}, {}, {}, {}, false, {}};
  table.camera = posesByFrame(table.clock, estimate.camera);
  table.true_camera = posesByFrame(table.clock, truth.camera);
  for (const auto& [id, poses] : estimate.motions)
    if (id >= 1) table.motions[id] = posesByFrame(table.clock, poses);
  for (const auto& [body, poses] : truth.bodies)
    table.bodies[body] = posesByFrame(table.clock, poses);
  table.labels = labelsByFrame(table.clock, estimate.labels);
  for (const auto& labels : table.labels) {
    FrameIds ids;
    std::map<int, int> support;
    for (const LabelRow& label : labels) {
      ids.insert(label.motion_id);
      ++support[label.motion_id];
    }
    table.ids.push_back(std::move(ids));
    table.supports.push_back(std::move(support));
  }
  if (truth.mask) {
    for (std::size_t k = 0; k < table.clock.frames(); ++k)
      table.points.push_back(table.labels[k].empty() ? std::vector<MaskedPoint>{}
                                                     : maskPoints(table.labels[k], truth.mask(k)));
  }
  // A scene without bodies has no visibility to tell, but its masks say that it knows its bodies.
  table.has_visibility = !truth.visibility.empty() || (truth.mask && truth.bodies.empty());
  if (table.has_visibility) addVisibility(truth, table);
  return table;
}

int count(const FramePoses& poses) {
  return static_cast<int>(
      std::count_if(poses.begin(), poses.end(), [](const auto& pose) { return pose.has_value(); }));
}

AlignedTrack aligned(const FramePoses& poses, const Alignment& alignment) {
  AlignedTrack track(poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (poses[k]) track[k] = AlignedPose{0, alignment(*poses[k])};
  return track;
}

std::optional<CameraEvaluation> evaluateCamera(const Table& table, CameraAlignment kind) {
  const auto alignment = kind == CameraAlignment::kLeft
                             ? alignLeft(table.camera, table.true_camera)
                             : alignLeftRight(table.camera, table.true_camera);
  if (!alignment) return {};
  CameraEvaluation camera;
  camera.alignment = *alignment;
  camera.path = pathLength(table.true_camera);
  camera.estimated = count(table.camera);
  camera.coverage = 100.0 * camera.estimated / static_cast<double>(table.clock.frames());
  const AlignedTrack track = aligned(table.camera, *alignment);
  camera.curve = cameraErrors(track, table.true_camera);
  camera.errors = summarize(camera.curve, camera.path);
  camera.steps = summarize(cameraStepErrors(track, table.true_camera));
  camera.scale = pathScale(track, table.true_camera);
  camera.drift = endDrift(table.camera, table.true_camera);
  return camera;
}

// T_ck_l of a body, or of the world if there is none.
FramePoses inCamera(const FramePoses& T_world_camera, const FramePoses* T_world_l) {
  FramePoses poses(T_world_camera.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (!T_world_camera[k] || (T_world_l != nullptr && !(*T_world_l)[k])) continue;
    const Eigen::Isometry3d T_camera_world = T_world_camera[k]->inverse();
    poses[k] = T_world_l != nullptr ? T_camera_world * *(*T_world_l)[k] : T_camera_world;
  }
  return poses;
}

std::vector<bool> framesIn(const std::vector<BodyState>& states, View view) {
  std::vector<bool> keep;
  keep.reserve(states.size());
  for (const BodyState& state : states) keep.push_back(state.view == view);
  return keep;
}

std::vector<StepError> visibleSteps(const std::vector<StepError>& steps,
                                    const std::vector<bool>& visible) {
  std::vector<StepError> kept;
  for (const StepError& step : steps)
    if (visible[step.frame - 1] && visible[step.frame]) kept.push_back(step);
  return kept;
}

std::vector<StretchEvaluation> evaluateStretches(const BodyEvaluation& body,
                                                 const std::vector<BodyState>& states,
                                                 const std::vector<bool>& visible) {
  std::vector<StretchEvaluation> result;
  for (const Stretch& stretch : stretchesInView(states)) {
    std::vector<bool> inside(states.size(), false);
    std::fill(inside.begin() + static_cast<std::ptrdiff_t>(stretch.first),
              inside.begin() + static_cast<std::ptrdiff_t>(stretch.last) + 1, true);
    const std::vector<PoseError> errors = restrictTo(body.curve, inside);
    result.push_back(
        {stretch, summarize(errors, body.path), summarize(restrictTo(errors, visible), body.path)});
  }
  return result;
}

void addVisibleFigures(const std::vector<BodyState>& states, const AlignedTrack& track,
                       const std::vector<StepError>& steps, BodyEvaluation& body) {
  body.has_visibility = true;
  const std::vector<bool> visible = framesIn(states, View::kVisible);
  int required_found = 0;
  int visible_found = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const int found = track[k] ? 1 : 0;
    if (visible[k]) {
      ++body.visible_frames;
      visible_found += found;
    }
    if (states[k].role() == Role::kRequired) {
      ++body.required_frames;
      required_found += found;
    }
  }
  if (body.required_frames > 0) body.coverage = 100.0 * required_found / body.required_frames;
  if (body.visible_frames > 0) body.coverage_visible = 100.0 * visible_found / body.visible_frames;
  body.visible_errors = summarize(restrictTo(body.curve, visible), body.path);
  body.visible_steps = summarize(visibleSteps(steps, visible));
  body.stretches = evaluateStretches(body, states, visible);
}

BodyEvaluation evaluateBody(int id, const Table& table, const Association& association,
                            const Eigen::Isometry3d& A) {
  const FramePoses& truth = table.bodies.at(id);
  const BodyTrack track = trackBody(id, table.motions, association, truth, A, table.supports);
  BodyEvaluation body;
  body.body = id;
  body.path = pathLength(truth);
  body.ids = track.ids;
  body.duplicate_frames = track.duplicate_frames;
  body.estimated = static_cast<int>(std::count_if(
      track.poses.begin(), track.poses.end(), [](const auto& pose) { return pose.has_value(); }));
  body.curve = bodyErrors(track.poses, truth);
  body.errors = summarize(body.curve, body.path);
  const std::vector<StepError> steps = bodyStepErrors(track.poses, truth);
  body.steps = summarize(steps);
  if (table.has_visibility) addVisibleFigures(table.states.at(id), track.poses, steps, body);
  if (!table.points.empty()) {
    body.has_masks = true;
    body.id_switches = idSwitches(dominantIds(table.points, id));
    if (table.has_visibility)
      body.one_label = oneLabelPercent(table.points, id, table.states.at(id));
  }
  return body;
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

void addAlignmentNote(const Table& table, Evaluation& evaluation) {
  const double left = misfit(evaluation.camera->alignment, table.camera, table.true_camera);
  const double left_right =
      misfit(*alignLeftRight(table.camera, table.true_camera), table.camera, table.true_camera);
  if (left < kDoubtfulMisfit || left_right > kClearlyBetter * left) return;
  evaluation.notes.push_back(
      "the camera's first poses fit the truth badly (misfit " + rounded(left) +
      "), and much better (" + rounded(left_right) +
      ") with another camera-fixed frame: is the estimate's frame not the left optical one? See "
      "--camera-alignment left-right");
}

void addSpanNote(const Table& table, Evaluation& evaluation) {
  std::size_t first = table.clock.frames();
  std::size_t last = 0;
  for (std::size_t k = 0; k < table.clock.frames(); ++k)
    if (table.camera[k] || !table.labels[k].empty()) {
      first = std::min(first, k);
      last = k;
    }
  if (first > last || (first < kBirth && last + 1 == table.clock.frames())) return;
  evaluation.notes.push_back("the estimate covers frames " + std::to_string(first) + " to " +
                             std::to_string(last) + " of " + std::to_string(table.clock.frames()) +
                             "; all count, unless --frames estimate says otherwise");
}

void addLabelScores(const Table& table, Evaluation& evaluation) {
  evaluation.third_party_frames = framesWithThirdParty(table.ids);
  if (!table.has_visibility) return;
  evaluation.counts = countMotions(table.ids, table.states, evaluation.association);
  evaluation.rates = rightNumberRates(evaluation.counts);
  if (table.points.empty()) return;
  const auto scores = scoreSegmentation(table.points, table.states, evaluation.association);
  evaluation.static_world = scores.at(0);
  for (BodyEvaluation& body : evaluation.bodies)
    if (const auto score = scores.find(body.body); score != scores.end())
      body.segmentation = score->second;
}

BoxEvaluation evaluateBoxes(const Table& table, const Truth& truth) {
  BoxEvaluation result;
  const FrameBoxes boxes = boxesByFrame(table.clock, truth.boxes);
  const auto owners = ownersOfIds(table.labels, boxes);
  std::set<std::string> names;
  for (const TrueBox& box : truth.boxes) names.insert(box.body);
  std::map<std::string, Holders> all;
  for (const std::string& name : names) {
    all[name] = holders(name, table.labels, boxes, owners);
    const BoxedBody body = scoreBoxedBody(name, table.labels, boxes, owners);
    if (body.frames == 0) continue;  // not in these frames
    result.bodies.push_back(body);
    result.own_label.frames += body.clear_frames;
    result.own_label.labelled += body.own_label;
  }
  result.background = scoreBackground(table.labels, boxes);
  const BoxScene scene{table.clock, table.camera,      table.true_camera, table.motions,
                       boxes,       truth.calibration, std::move(all)};
  for (BoxedBody& body : result.bodies) body.placement = placement(body.body, scene);
  result.velocities = scoreVelocities(truth.velocities, scene);
  return result;
}

}  // namespace

Evaluation evaluate(const Estimate& estimate, const Truth& truth,
                    const EvaluationOptions& options) {
  const Table table = makeTable(estimate, truth);
  if (count(table.camera) == 0 && std::all_of(table.labels.begin(), table.labels.end(),
                                              [](const auto& l) { return l.empty(); }))
    throw std::runtime_error(
        "estimate and truth share no frame: no stamp of the estimate is within "
        "0.3 frame periods of a true one");
  Evaluation evaluation;
  evaluation.frames = static_cast<int>(table.clock.frames());
  evaluation.times = stageTimes(estimate.timings);
  evaluation.camera = evaluateCamera(table, options.camera_alignment);
  if (!truth.camera.empty() && !evaluation.camera)
    evaluation.notes.push_back("no estimated camera pose has a true one");
  if (evaluation.camera && options.camera_alignment == CameraAlignment::kLeft)
    addAlignmentNote(table, evaluation);
  addSpanNote(table, evaluation);

  evaluation.association = associate(table.points);
  if (evaluation.camera) {
    evaluation.camera->consistency =
        consistencyOf(table.clock, estimate.covariances, {0}, inCamera(table.true_camera, nullptr));
    const Eigen::Isometry3d& A = evaluation.camera->alignment.A;
    if (!truth.mask && !table.bodies.empty()) {
      evaluation.association = associateByMotion(table.motions, table.bodies, A);
      evaluation.notes.push_back(
          "no masks: motions belong to the body whose trajectory they fit best");
    }
    for (const auto& [id, poses] : table.bodies)
      evaluation.bodies.push_back(evaluateBody(id, table, evaluation.association, A));
    for (BodyEvaluation& body : evaluation.bodies)
      body.consistency = consistencyOf(table.clock, estimate.covariances, body.ids,
                                       inCamera(table.true_camera, &table.bodies.at(body.body)));
  }
  if (estimate.has_labels) addLabelScores(table, evaluation);
  if (estimate.has_labels && !truth.boxes.empty()) evaluation.boxes = evaluateBoxes(table, truth);
  return evaluation;
}

Truth cropToEstimate(const Truth& truth, const Estimate& estimate) {
  const FrameClock clock(truth.stamps_ns);
  std::size_t first = clock.frames();
  std::size_t last = 0;
  const auto see = [&](std::int64_t stamp_ns) {
    const auto frame = clock.frameOf(stamp_ns);
    if (!frame) return;
    first = std::min(first, *frame);
    last = std::max(last, *frame);
  };
  for (const TimingRow& row : estimate.timings) see(row.stamp_ns);
  for (const StampedPose& pose : estimate.camera) see(pose.stamp_ns);
  for (const LabelRow& label : estimate.labels) see(label.stamp_ns);
  Truth cropped = truth;
  if (first > last) return cropped;
  cropped.stamps_ns.assign(truth.stamps_ns.begin() + static_cast<std::ptrdiff_t>(first),
                           truth.stamps_ns.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  if (truth.mask)
    cropped.mask = [mask = truth.mask, first](std::size_t frame) { return mask(first + frame); };
  return cropped;
}

}  // namespace mvo
