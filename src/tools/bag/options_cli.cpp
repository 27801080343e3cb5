// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/options_cli.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "tools/bag/options_file.hpp"

namespace mvo_tools {

namespace {

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

// Which keys of a file the method does not have, as they are the live node's.
std::string noticeOf(const std::string& file, const mvo_ros::KeyValues& pairs) {
  mvo_ros::NodeOptions node;
  const auto rows = mvo_ros::nodeOptionTable(node);
  std::string names;
  for (const auto& pair : pairs)
    if (std::any_of(rows.begin(), rows.end(), [&](auto& row) { return row.name == pair.first; }))
      names.append(names.empty() ? "" : ", ").append(pair.first);
  if (names.empty()) return "";
  return "options file '" + file + "': passed over, as only the live node has them: " + names;
}

}  // namespace

OptionsCli::OptionsCli(CLI::App& app) {
  app.add_option("--profile", profile_, "constants to start from: default or paper")
      ->group("method");
  app.add_option("--config", file_,
                 "file of options: YAML (config/mvo.yaml, dumps of a node's parameters or live "
                 "settings), JSON (also an earlier summary.json) or lines \"name = value\"")
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

ChosenOptions OptionsCli::chosen() const {
  ChosenOptions out;
  out.profile = profile_;
  mvo_ros::Parameters parameters;
  parameters.method = mvo::optionsOfProfile(profile_);
  if (!file_.empty()) {
    const mvo_ros::KeyValues pairs = readOptionsFile(file_);
    out.notice = noticeOf(file_, pairs);
    try {
      parameters = mvo_ros::withKeys(parameters, pairs);
    } catch (const std::exception& error) {
      throw std::runtime_error("options file '" + file_ + "': " + error.what());
    }
  }
  out.options = parameters.method;
  for (const auto& [name, value] : given_) mvo::setOption(out.options, name, value);
  out.options.validate();
  return out;
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
