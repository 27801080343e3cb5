// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The method's option table on the command line: --profile, --config and one --<stage>.<field>
// each.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "mvo/options.hpp"

namespace mvo_tools {

/// Adds the table's options to an app, which it must outlive, and collects what is given.
class OptionsCli {
 public:
  explicit OptionsCli(CLI::App& app);
  OptionsCli(const OptionsCli&) = delete;
  OptionsCli& operator=(const OptionsCli&) = delete;

  /// The profile, changed by the file, changed by the command line; validated. Throws
  /// std::exception with one sentence that names option, value and range, or file.
  mvo::Options options() const;
  const std::string& profile() const { return profile_; }
  /// --options was given: print optionTableText() and be done.
  bool tableWanted() const { return table_wanted_; }

 private:
  std::string profile_ = "default";
  std::string file_;
  bool table_wanted_ = false;
  std::vector<std::pair<std::string, std::string>> given_;
};

/// Name and value pairs of an options file: JSON (flat or nested by stage; a run's summary.json
/// does), "name = value" lines with [stage] sections, or, if its name ends in .yaml, "name: value"
/// lines. Throws std::runtime_error naming the file.
std::vector<std::pair<std::string, std::string>> readOptionsFile(const std::string& path);

/// The table as text: name, default, the paper profile's value, range, unit, meaning.
std::string optionTableText();

}  // namespace mvo_tools
