// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Do the trajectories of bodies in hand-drawn boxes go where the boxes and the mean velocities say?
#pragma once

#include <map>
#include <string>

#include "eval/body_track.hpp"
#include "eval/box_labels.hpp"

namespace mvo {

/// What the trajectories are compared by. All by the same frames, the estimate in its own world.
struct BoxScene {
  const FrameClock& clock;
  const FramePoses& camera;
  const FramePoses& true_camera;
  const MotionPoses& motions;
  const FrameBoxes& boxes;
  const std::optional<StereoCamera>& calibration;
  std::map<std::string, Holders> holders;  ///< by body
};

/// Frames in which the id that holds the body, or held it last, has a pose and a camera to see it
/// by; in how many of them its frame's position appears inside of the body's box. None without
/// calibration.
std::optional<BoxPlacement> placement(const std::string& body, const BoxScene& scene);

/// The displacement of the id that holds the body in most of the frames and has poses in the first
/// and the last. Velocities of which a frame is missing are left out.
std::vector<VelocityScore> scoreVelocities(const std::vector<TrueVelocity>& velocities,
                                           const BoxScene& scene);

/// The depth of a body halfway, if the camera rests: the displacement over the way its box goes in
/// the image. None if it is known to no better than 20 %.
std::optional<ImpliedDepth> impliedDepth(const TrueVelocity& velocity, const BoxScene& scene);

}  // namespace mvo
