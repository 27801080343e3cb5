// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters/parameters.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "option_table.hpp"

namespace mvo_ros {

namespace {

// What the node's helpers keep in its namespace.
bool isForeign(const std::string& key) {
  return key == "diagnostic_period" || key.rfind("live.", 0) == 0 ||
         key.rfind("segmentation.", 0) == 0;
}

void flattenInto(XmlRpc::XmlRpcValue value, const std::string& key, KeyValues& pairs) {
  std::ostringstream text;
  text.precision(17);
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeStruct:
      for (auto& [name, child] : value)
        flattenInto(child, key.empty() ? name : std::string(key).append(".").append(name), pairs);
      return;
    case XmlRpc::XmlRpcValue::TypeBoolean:
      text << (static_cast<bool>(value) ? "true" : "false");
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      text << static_cast<int>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      text << static_cast<double>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeString:
      text << static_cast<std::string>(value);
      break;
    default:
      if (isForeign(key)) return;
      throw std::invalid_argument("parameter '" + key + "' is neither a number, a word nor a flag");
  }
  pairs.emplace_back(key, text.str());
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

[[noreturn]] void refuseKey(const std::string& key, const std::vector<mvo::OptionEntry>& rows) {
  const auto nearest = std::min_element(rows.begin(), rows.end(), [&key](auto& a, auto& b) {
    return editDistance(a.name, key) < editDistance(b.name, key);
  });
  throw std::invalid_argument("there is no parameter '" + key + "' (did you mean '" +
                              nearest->name + "'?); config/mvo.yaml lists them all");
}

std::string yamlValue(const mvo::OptionEntry& row) {
  const std::string value = row.get();
  return value.empty() || value == "off" ? '"' + value + '"' : value;
}

// name without its stage, and the stage.
std::pair<std::string, std::string> split(const std::string& name) {
  const auto dot = name.find('.');
  if (dot == std::string::npos) return {"", name};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

// The options that matter, and when to change them. Nobody needs to touch the others.
struct When {
  const char* option;
  const char* text;
};
constexpr When kWhen[] = {
    {"window.frames",
     "trajectories jitter or slow bodies are missed: more; a step lasts too long: fewer"},
    {"frontend.max_features",
     "small bodies are missed: more; the node sheds features or lags: fewer"},
    {"frontend.shutter", "you know the camera's shutter: global, or rolling with its readout"},
    {"noise.left", "points are followed worse than in clean images (blur, compression): more"},
    {"noise.disparity",
     "depth is noisier than that of a sharp stereo pair (RGB-D, a pair that is off): more"},
    {"engine.time_budget_ms",
     "a step must never last longer on this machine, whatever it leaves out"},
};

void writeRow(std::ostream& out, const mvo::OptionEntry& row, const std::string& indent,
              const std::string& name, const std::string& paper) {
  const std::string unit = row.unit.empty() ? "" : " [" + row.unit + "]";
  out << indent << "# " << row.help << unit << "; " << row.range;
  if (!paper.empty()) out << "; paper: " << paper;
  out << '\n';
  for (const When& when : kWhen)
    if (row.name == when.option) out << indent << "# WHEN to change it: " << when.text << '\n';
  out << indent << name << ": " << yamlValue(row) << "\n";
}

}  // namespace

KeyValues flatten(const XmlRpc::XmlRpcValue& tree) {
  KeyValues pairs;
  if (tree.valid()) flattenInto(tree, "", pairs);
  return pairs;
}

Parameters withKeys(Parameters parameters, const KeyValues& pairs) {
  auto rows = nodeOptionTable(parameters.node);
  for (auto& row : mvo::optionTable(parameters.method)) rows.push_back(std::move(row));
  for (const auto& [key, value] : pairs) {
    if (isForeign(key)) continue;
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [name = key](const auto& r) { return r.name == name; });
    if (row == rows.end()) refuseKey(key, rows);
    row->set(value);
  }
  parameters.node.validate();
  parameters.method.validate();
  return parameters;
}

Parameters readParameters(const XmlRpc::XmlRpcValue& tree) {
  return withKeys(Parameters(), flatten(tree));
}

std::string parametersYaml(const std::string& profile) {
  Parameters defaults;
  defaults.method = mvo::optionsOfProfile(profile);
  mvo::Options paper = mvo::paperOptions();
  std::ostringstream out;
  out << "# Parameters of the mvo node, the " << profile
      << " profile: meaning [unit]; range; the paper's value where it is another.\n"
         "# The six that matter say WHEN to change them; nobody needs to touch the others.\n"
         "# rosrun mvo bag --config reads this file as it is. Printed by: rosrun mvo mvo_node "
         "--yaml "
      << profile << "\n\n";
  for (const auto& row : nodeOptionTable(defaults.node)) writeRow(out, row, "", row.name, "");
  const auto rows = mvo::optionTable(defaults.method);
  const auto paper_rows = mvo::optionTable(paper);
  std::string stage;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [of, name] = split(rows[i].name);
    if (of != stage) out << '\n' << of << ":\n";
    stage = of;
    const std::string of_paper = paper_rows[i].get();
    writeRow(out, rows[i], of.empty() ? "" : "  ", name, of_paper == rows[i].get() ? "" : of_paper);
  }
  return out.str();
}

std::string parametersText(Parameters parameters) {
  std::ostringstream out;
  for (const auto& rows : {nodeOptionTable(parameters.node), mvo::optionTable(parameters.method)})
    for (const auto& row : rows) out << "  " << row.name << ": " << yamlValue(row) << '\n';
  return out.str();
}

}  // namespace mvo_ros
