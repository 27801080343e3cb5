// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Builds the rows of an option table; each member function knows one kind of value.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "mvo/options.hpp"

namespace mvo {

/// The fields must outlive the rows.
class OptionTable {
 public:
  template <class Number>
  void number(const std::string& name, Number& field, Number low, Number high,
              const std::string& unit, const std::string& help) {
    const std::string range =
        "in [" + text(static_cast<double>(low)) + ", " + text(static_cast<double>(high)) + "]";
    const std::string wanted = (std::is_integral_v<Number> ? "a whole number " : "") + range;
    const auto set = [&field, name, low, high, wanted, unit](const std::string& value) {
      const double parsed = parseNumber(name, value, wanted, unit);
      const auto converted =
          static_cast<Number>(parsed < static_cast<double>(low)    ? low
                              : parsed > static_cast<double>(high) ? high
                                                                   : static_cast<Number>(parsed));
      if (parsed < static_cast<double>(low) || parsed > static_cast<double>(high) ||
          static_cast<double>(converted) != parsed)
        refuse(name, value, wanted, unit);
      field = converted;
    };
    rows.push_back(
        {name, unit, range, help, [&field] { return text(static_cast<double>(field)); }, set});
  }

  void flag(const std::string& name, bool& field, const std::string& help) {
    const auto set = [&field, name](const std::string& value) {
      if (value != "true" && value != "false") refuse(name, value, "true or false", "");
      field = value == "true";
    };
    rows.push_back(
        {name, "", "true | false", help, [&field] { return field ? "true" : "false"; }, set});
  }

  template <class Enum>
  void choice(const std::string& name, Enum& field, const std::vector<std::string>& words,
              const std::string& help) {
    std::string range;
    for (const auto& word : words) range += (range.empty() ? "" : " | ") + word;
    const auto set = [&field, name, words, range](const std::string& value) {
      // YAML reads the bare word off as a flag.
      const auto it = std::find(words.begin(), words.end(), value == "false" ? "off" : value);
      if (it == words.end()) refuse(name, value, "one of " + range, "");
      field = static_cast<Enum>(it - words.begin());
    };
    rows.push_back({name, "", range, help,
                    [&field, words] { return words[static_cast<std::size_t>(field)]; }, set});
  }

  void word(const std::string& name, std::string& field, const std::string& help) {
    rows.push_back({name, "", "text", help, [&field] { return field; },
                    [&field](const std::string& value) { field = value; }});
  }

  std::vector<OptionEntry> rows;

  /// As short as twelve digits allow.
  static std::string text(double value);

 private:
  [[noreturn]] static void refuse(const std::string& name, const std::string& value,
                                  const std::string& range, const std::string& unit);
  static double parseNumber(const std::string& name, const std::string& value,
                            const std::string& range, const std::string& unit);
};

/// Sets the row of that name; throws std::invalid_argument for unknown names, wrong types and
/// values out of range.
void setRow(const std::vector<OptionEntry>& rows, const std::string& name,
            const std::string& value);

}  // namespace mvo
