// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/box_motions.hpp"

#include <cmath>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

using Eigen::Vector3d;

constexpr double kBoxError = 4;              // of an edge [px]
constexpr double kMaxRelativeError = 0.2;    // of a depth worth telling
constexpr double kRestingDistance = 0.01;    // [m]
constexpr double kRestingAngle = 0.0017453;  // 0.1 degrees [rad]

const FramePoses* posesOf(int id, const MotionPoses& motions) {
  const auto found = motions.find(id);
  return found == motions.end() ? nullptr : &found->second;
}

// The body frame's position in the camera's axes, if both have a pose.
std::optional<Vector3d> positionInCamera(int id, std::size_t frame, const BoxScene& scene) {
  const FramePoses* poses = posesOf(id, scene.motions);
  if (poses == nullptr || !(*poses)[frame] || !scene.camera[frame]) return {};
  return scene.camera[frame]->inverse() * (*poses)[frame]->translation();
}

// Of the ids that have poses at both ends the one that holds the body most often.
int heldThroughout(const Holders& holders, std::size_t first, std::size_t last,
                   const BoxScene& scene) {
  std::map<int, int> counts;
  for (std::size_t k = first; k <= last; ++k)
    if (holders[k] && positionInCamera(*holders[k], first, scene) &&
        positionInCamera(*holders[k], last, scene))
      ++counts[*holders[k]];
  int best = 0;
  for (const auto& [id, count] : counts)
    if (best == 0 || count > counts.at(best)) best = id;
  return best;
}

bool cameraRests(const BoxScene& scene, std::size_t first, std::size_t last) {
  const auto& a = scene.true_camera[first];
  const auto& b = scene.true_camera[last];
  if (!a || !b) return false;
  const Eigen::Isometry3d moved = a->inverse() * *b;
  return moved.translation().norm() <= kRestingDistance && angle(moved.linear()) <= kRestingAngle;
}

double seconds(const TrueVelocity& velocity) {
  return 1e-9 * static_cast<double>(velocity.last_ns - velocity.first_ns);
}

void addEstimate(int id, double dt, const BoxScene& scene, VelocityScore& score) {
  score.id = id;
  const FramePoses& poses = scene.motions.at(id);
  const Vector3d moved = poses[score.last]->translation() - poses[score.first]->translation();
  score.velocity = scene.camera[score.first]->linear().transpose() * moved / dt;
  score.depth = 0.5 * (positionInCamera(id, score.first, scene)->z() +
                       positionInCamera(id, score.last, scene)->z());
  score.displacement_error = dt * std::hypot(score.errorX(), score.errorZ());
}

}  // namespace

std::optional<BoxPlacement> placement(const std::string& body, const BoxScene& scene) {
  if (!scene.calibration) return {};
  BoxPlacement result;
  std::optional<int> id;
  const Holders& holders = scene.holders.at(body);
  for (std::size_t k = 0; k < scene.boxes.size(); ++k) {
    if (holders[k]) id = holders[k];
    const TrueBox* box = boxOf(body, scene.boxes[k]);
    if (!id || box == nullptr) continue;
    const auto p = positionInCamera(*id, k, scene);
    if (!p) continue;
    ++result.frames;
    if (p->z() <= 0) continue;  // behind the camera is in no box
    const Vector3d seen = scene.calibration->project(*p);
    if (contains(*box, seen.x(), seen.y())) ++result.inside;
  }
  return result;
}

std::vector<VelocityScore> scoreVelocities(const std::vector<TrueVelocity>& velocities,
                                           const BoxScene& scene) {
  std::vector<VelocityScore> scores;
  for (const TrueVelocity& velocity : velocities) {
    const auto first = scene.clock.frameOf(velocity.first_ns);
    const auto last = scene.clock.frameOf(velocity.last_ns);
    const auto holders = scene.holders.find(velocity.body);
    if (!first || !last || holders == scene.holders.end()) continue;
    VelocityScore score;
    score.truth = velocity;
    score.first = *first;
    score.last = *last;
    score.implied_depth = impliedDepth(velocity, scene);
    const int id = heldThroughout(holders->second, *first, *last, scene);
    if (id >= 1) addEstimate(id, seconds(velocity), scene, score);
    scores.push_back(score);
  }
  return scores;
}

std::optional<ImpliedDepth> impliedDepth(const TrueVelocity& velocity, const BoxScene& scene) {
  const auto first = scene.clock.frameOf(velocity.first_ns);
  const auto last = scene.clock.frameOf(velocity.last_ns);
  if (!first || !last || !scene.calibration || !cameraRests(scene, *first, *last)) return {};
  const TrueBox* from = boxOf(velocity.body, scene.boxes[*first]);
  const TrueBox* to = boxOf(velocity.body, scene.boxes[*last]);
  if (from == nullptr || to == nullptr) return {};
  const StereoCamera& camera = *scene.calibration;
  const auto slope = [&](const TrueBox& box) {  // x / z of its middle
    return (box.x + 0.5 * box.width - camera.cu) / camera.fu;
  };
  const double dt = seconds(velocity);
  const double dx = dt * velocity.vx;
  const double dz = dt * velocity.vz;
  // (s_1 z + dx) / (z + dz) = s_2 for the depth z at the first frame.
  const double turned = slope(*to) - slope(*from);
  ImpliedDepth depth;
  depth.z = (dx - slope(*to) * dz) / turned + 0.5 * dz;
  // A middle is as uncertain as an edge over the square root of 2, and there are two of them.
  const double relative = std::hypot(velocity.sd / velocity.vx, kBoxError / camera.fu / turned);
  if (!(relative <= kMaxRelativeError) || depth.z <= 0) return {};
  depth.sd = relative * depth.z;
  return depth;
}

}  // namespace mvo
