// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the simulated camera can be told.
#pragma once

#include <XmlRpcValue.h>

#include <string>

#include "mvo/sim.hpp"
#include "ros/sensor/sensor_model.hpp"

namespace mvo_ros {

struct SimulatorOptions {
  std::string scene = "blocks";
  int seed = 1;
  Sensor sensor = Sensor::kStereo;
  mvo::sim::SceneOptions camera;  ///< rgbd follows from `sensor`
  int frames = 0;                 ///< to publish; 0 = without end
  int prerender = 0;              ///< frames to render first and then play to and fro; 0 = none
  bool wait = false;              ///< for a subscriber of every image, before the first frame
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
};

/// The options of a private namespace. Throws std::invalid_argument, one sentence that names the
/// key, its value and its range; unknown keys are errors. Keys below image topics belong to
/// image_transport.
SimulatorOptions simulatorOptions(const XmlRpc::XmlRpcValue& tree);

}  // namespace mvo_ros
