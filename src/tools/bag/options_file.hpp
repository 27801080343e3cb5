// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files of options: what a node was started with, what was tuned while it ran, what an earlier run
// noted.
#pragma once

#include <string>

#include "ros/parameters/parameters.hpp"

namespace mvo_tools {

/// The keys and values of a file: YAML as config/mvo.yaml and `rosparam dump` of the node's
/// namespace have it, `dynparam dump` of the live settings, JSON (flat or nested by stage, or a
/// run's summary.json), or "name = value" lines with [stage] sections. Live settings have their
/// options' names and come last, as they are what was in force. Throws std::runtime_error naming
/// the file.
mvo_ros::KeyValues readOptionsFile(const std::string& path);

}  // namespace mvo_tools
