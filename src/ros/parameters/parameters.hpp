// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// ROS parameters to options: every key is known, of the right type and in range, or the error names
// it.
#pragma once

#include <XmlRpcValue.h>

#include <string>
#include <utility>
#include <vector>

#include "ros/parameters/node_options.hpp"

namespace mvo_ros {

/// All that the node can be told.
struct Parameters {
  NodeOptions node;
  mvo::Options method;
};

/// The leaves of a tree of parameters, nested keys joined by dots, and their values as text.
using KeyValues = std::vector<std::pair<std::string, std::string>>;

/// The leaves of a tree. Throws std::invalid_argument naming a key whose value is no number, word
/// or flag.
KeyValues flatten(const XmlRpc::XmlRpcValue& tree);

/// The parameters changed by the keys given. Keys that the node's helpers keep beside them (live.,
/// segmentation., diagnostic_period) are passed over. Throws std::invalid_argument, one sentence
/// that names the key, its value and its range.
Parameters withKeys(Parameters parameters, const KeyValues& pairs);

/// The parameters of a private namespace: the defaults, changed by the keys given there. Throws
/// like withKeys().
Parameters readParameters(const XmlRpc::XmlRpcValue& tree);

/// config/mvo.yaml (profile default) or config/paper.yaml: every key with its value, meaning, unit,
/// range and the paper's value.
std::string parametersYaml(const std::string& profile);

/// One "key: value" line per option in force.
std::string parametersText(Parameters parameters);

}  // namespace mvo_ros
