// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "option_table.hpp"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace mvo {

std::string OptionTable::text(double value) {
  std::ostringstream out;
  out.precision(12);
  out << value;
  return out.str();
}

void OptionTable::refuse(const std::string& name, const std::string& value,
                         const std::string& range, const std::string& unit) {
  throw std::invalid_argument("option " + name + " is '" + value + "', it must be " + range +
                              (unit.empty() ? "" : " " + unit));
}

double OptionTable::parseNumber(const std::string& name, const std::string& value,
                                const std::string& range, const std::string& unit) {
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !(number == number)) refuse(name, value, range, unit);
  return number;
}

void setRow(const std::vector<OptionEntry>& rows, const std::string& name,
            const std::string& value) {
  for (const OptionEntry& row : rows)
    if (row.name == name) return row.set(value);
  throw std::invalid_argument("there is no option '" + name +
                              "'; `rosrun mvo bag --options` lists them all");
}

}  // namespace mvo
