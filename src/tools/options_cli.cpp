// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options_cli.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace mvo_tools {

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

// The ones that are typed often have a short name too.
std::string flagNames(const std::string& name) {
  std::string names = "--" + name;
  if (name == "engine.engine" || name == "engine.solver" || name == "frontend.tracker")
    names.append(",--").append(name, name.find('.') + 1);
  return names;
}

std::string stageOf(const std::string& name) {
  const auto dot = name.find('.');
  return dot == std::string::npos ? "method" : "method, stage " + name.substr(0, dot);
}

void flatten(const nlohmann::json& node, const std::string& name, Pairs& pairs) {
  if (node.is_object()) {
    for (const auto& [key, child] : node.items())
      flatten(child, name.empty() ? key : std::string(name).append(".").append(key), pairs);
  } else {
    pairs.emplace_back(name, node.is_string() ? node.get<std::string>() : node.dump());
  }
}

Pairs readJson(std::istream& stream) {
  const auto root = nlohmann::json::parse(stream);
  Pairs pairs;
  flatten(root.is_object() && root.contains("options") ? root["options"] : root, "", pairs);
  return pairs;
}

Pairs readLines(std::istream& stream, char separator) {
  CLI::ConfigBase format;
  format.valueSeparator(separator);
  Pairs pairs;
  for (const CLI::ConfigItem& item : format.from_config(stream)) {
    if (item.name == "++" || item.name == "--") continue;  // a section begins or ends
    if (item.inputs.size() != 1)
      throw std::runtime_error("option " + item.fullname() + " has " +
                               std::to_string(item.inputs.size()) + " values, it must have one");
    pairs.emplace_back(item.fullname(), item.inputs.front());
  }
  return pairs;
}

}  // namespace

OptionsCli::OptionsCli(CLI::App& app) {
  app.add_option("--profile", profile_, "constants to start from: default or paper")
      ->group("method");
  app.add_option("--config", file_,
                 "file of options: JSON (also an earlier summary.json) or lines \"name = value\"")
      ->group("method");
  app.add_flag_callback(
         "--options",
         [this] {
           table_wanted_ = true;
           throw CLI::Success();
         },
         "print every option of the method with default, range, unit and meaning, and exit")
      ->group("method");
  mvo::Options defaults;
  for (const mvo::OptionEntry& entry : mvo::optionTable(defaults)) {
    const std::string unit = entry.unit.empty() ? "" : " " + entry.unit;
    app.add_option_function<std::string>(
           flagNames(entry.name),
           [this, name = entry.name](const std::string& value) {
             given_.emplace_back(name, value);
           },
           entry.help + "; " + entry.range + unit + ", default " + entry.get())
        ->type_name("")
        ->group(stageOf(entry.name));
  }
}

mvo::Options OptionsCli::options() const {
  mvo::Options options = mvo::optionsOfProfile(profile_);
  if (!file_.empty()) {
    for (const auto& [name, value] : readOptionsFile(file_)) {
      try {
        mvo::setOption(options, name, value);
      } catch (const std::exception& error) {
        throw std::runtime_error("options file '" + file_ + "': " + error.what());
      }
    }
  }
  for (const auto& [name, value] : given_) mvo::setOption(options, name, value);
  options.validate();
  return options;
}

Pairs readOptionsFile(const std::string& path) {
  std::ifstream stream(path);
  if (!stream || !std::filesystem::is_regular_file(path))
    throw std::runtime_error("options file '" + path + "' cannot be read");
  try {
    stream >> std::ws;
    if (stream.peek() == '{') return readJson(stream);
    const std::string extension = std::filesystem::path(path).extension();
    return readLines(stream, extension == ".yaml" || extension == ".yml" ? ':' : '=');
  } catch (const std::exception& error) {
    throw std::runtime_error("options file '" + path + "': " + error.what());
  }
}

std::string optionTableText() {
  mvo::Options defaults;
  mvo::Options paper = mvo::paperOptions();
  const auto rows = mvo::optionTable(defaults);
  const auto paper_rows = mvo::optionTable(paper);
  std::vector<std::vector<std::string>> cells = {
      {"name", "default", "paper", "range", "unit", "meaning"}};
  for (std::size_t i = 0; i < rows.size(); ++i)
    cells.push_back({rows[i].name, rows[i].get(), paper_rows[i].get(), rows[i].range, rows[i].unit,
                     rows[i].help});
  std::vector<std::size_t> widths(cells.front().size(), 0);
  for (const auto& row : cells)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::ostringstream out;
  for (const auto& row : cells) {
    for (std::size_t c = 0; c + 1 < row.size(); ++c)
      out << std::left << std::setw(static_cast<int>(widths[c]) + 2) << row[c];
    out << row.back() << '\n';
  }
  return out.str();
}

}  // namespace mvo_tools
