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

/// What a command line says about the method.
struct ChosenOptions {
  mvo::Options options;
  std::string profile;
  std::string notice;  ///< one sentence on keys of the file that only the live node has, or empty
};

/// Adds the table's options to an app, which it must outlive, and collects what is given.
class OptionsCli {
 public:
  explicit OptionsCli(CLI::App& app);
  OptionsCli(const OptionsCli&) = delete;
  OptionsCli& operator=(const OptionsCli&) = delete;

  /// The profile, changed by the file, changed by the command line; validated. Throws
  /// std::exception with one sentence that names option, value and range, or file.
  ChosenOptions chosen() const;
  /// --options was given: print optionTableText() and be done.
  bool tableWanted() const { return table_wanted_; }

 private:
  std::string profile_ = "default";
  std::string file_;
  bool table_wanted_ = false;
  std::vector<std::pair<std::string, std::string>> given_;
};

/// The table as text: name, default, the paper profile's value, range, unit, meaning.
std::string optionTableText();

}  // namespace mvo_tools
