// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/options_file.hpp"

#include <yaml-cpp/yaml.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace mvo_tools {

namespace {

using mvo_ros::KeyValues;

const std::string kLive = "live.";  // where the node keeps its live settings

// dynamic_reconfigure has no dots in its names: energy_threshold is energy.threshold.
std::string optionOfSetting(const std::string& setting) {
  mvo_ros::NodeOptions node;
  for (const mvo::OptionEntry& row : mvo_ros::nodeOptionTable(node))
    if (row.name == setting) return setting;
  mvo::Options options;
  for (const mvo::OptionEntry& row : mvo::optionTable(options)) {
    std::string name = row.name;
    std::replace(name.begin(), name.end(), '.', '_');
    if (name == setting) return row.name;
  }
  return setting;
}

std::string valueOf(const YAML::Node& node) {
  if (!node.IsScalar()) return YAML::Dump(node);
  const bool quoted = node.Tag() == "!";
  bool flag = false;
  if (!quoted && YAML::convert<bool>::decode(node, flag)) return flag ? "true" : "false";
  return node.Scalar();
}

void flatten(const YAML::Node& node, const std::string& name, KeyValues& pairs) {
  if (!node.IsMap()) {
    pairs.emplace_back(name, valueOf(node));
    return;
  }
  for (const auto& child : node) {
    const auto key = child.first.as<std::string>();
    flatten(child.second, name.empty() ? key : std::string(name).append(".").append(key), pairs);
  }
}

KeyValues readYaml(std::istream& stream) {
  YAML::Node root = YAML::Load(stream);
  if (root.IsMap() && root["options"]) root = root["options"];  // a run's summary
  if (root.IsNull()) return {};
  if (!root.IsMap()) throw std::runtime_error("it holds no keys");
  root.remove("groups");  // of dynparam: how a window shows the settings
  KeyValues pairs;
  flatten(root, "", pairs);
  const auto live = std::stable_partition(
      pairs.begin(), pairs.end(), [](const auto& pair) { return pair.first.rfind(kLive, 0) != 0; });
  for (auto pair = live; pair != pairs.end(); ++pair) pair->first.erase(0, kLive.size());
  for (auto& pair : pairs) pair.first = optionOfSetting(pair.first);
  return pairs;
}

KeyValues readLines(std::istream& stream) {
  KeyValues pairs;
  for (const CLI::ConfigItem& item : CLI::ConfigBase().from_config(stream)) {
    if (item.name == "++" || item.name == "--") continue;  // a section begins or ends
    if (item.inputs.size() != 1)
      throw std::runtime_error("option " + item.fullname() + " has " +
                               std::to_string(item.inputs.size()) + " values, it must have one");
    pairs.emplace_back(item.fullname(), item.inputs.front());
  }
  return pairs;
}

}  // namespace

KeyValues readOptionsFile(const std::string& path) {
  std::ifstream stream(path);
  if (!stream || !std::filesystem::is_regular_file(path))
    throw std::runtime_error("options file '" + path + "' cannot be read");
  const std::string extension = std::filesystem::path(path).extension();
  try {
    stream >> std::ws;
    const bool yaml = extension == ".yaml" || extension == ".yml" || stream.peek() == '{';
    return yaml ? readYaml(stream) : readLines(stream);
  } catch (const std::exception& error) {
    throw std::runtime_error("options file '" + path + "': " + error.what());
  }
}

}  // namespace mvo_tools
