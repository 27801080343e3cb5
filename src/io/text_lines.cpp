// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_lines.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "io/stamp.hpp"

namespace mvo {

namespace {

constexpr const char* kBlanks = " \t";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> fields;
  if (separator == ' ') {
    for (std::size_t i = line.find_first_not_of(kBlanks); i != std::string::npos;) {
      const std::size_t end = line.find_first_of(kBlanks, i);
      fields.push_back(line.substr(i, end - i));
      i = line.find_first_not_of(kBlanks, end);
    }
    return fields;
  }
  for (std::size_t i = 0;;) {
    const std::size_t end = line.find(separator, i);
    fields.push_back(trimmed(line.substr(i, end - i)));
    if (end == std::string::npos) return fields;
    i = end + 1;
  }
}

}  // namespace

LineReader::LineReader(std::filesystem::path path, char separator)
    : path_(std::move(path)), stream_(path_), separator_(separator) {
  if (!stream_ || std::filesystem::is_directory(path_))
    throw std::runtime_error("cannot read " + path_.string());
}

bool LineReader::next() {
  while (std::getline(stream_, line_)) {
    ++line_number_;
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    const std::size_t first = line_.find_first_not_of(kBlanks);
    if (first == std::string::npos || line_[first] == '#') continue;
    fields_ = split(line_, separator_);
    return true;
  }
  return false;
}

const std::string& LineReader::text(std::size_t i) const {
  if (i >= fields_.size()) fail("field " + std::to_string(i + 1) + " is missing");
  return fields_[i];
}

double LineReader::number(std::size_t i) const {
  const std::string& field = text(i);
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (end == field.c_str() || *end != '\0' || !std::isfinite(value))
    failField(i, "'" + field + "' is not a finite number");
  return value;
}

std::int64_t LineReader::integer(std::size_t i) const {
  const std::string& field = text(i);
  char* end = nullptr;
  errno = 0;
  const long long value = std::strtoll(field.c_str(), &end, 10);
  if (end == field.c_str() || *end != '\0' || errno == ERANGE)
    failField(i, "'" + field + "' is not a whole number");
  return value;
}

std::int64_t LineReader::stamp(std::size_t i) const {
  const auto value = parseStamp(text(i));
  if (!value) failField(i, "'" + text(i) + "' is not a time stamp");
  return *value;
}

void LineReader::fail(const std::string& message) const {
  throw std::runtime_error(path_.string() + ":" + std::to_string(line_number_) + ": " + message);
}

void LineReader::failField(std::size_t i, const std::string& message) const {
  fail(i < names_.size() ? "column '" + names_[i] + "': " + message : message);
}

CsvReader::CsvReader(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : lines_(path, ',') {
  if (!lines_.next()) throw std::runtime_error(path.string() + " is empty");
  const std::vector<std::string>& header = lines_.fields();
  columns_ = header.size();
  for (const std::string& column : columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) lines_.fail("no column '" + column + "' in the header");
    index_.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  lines_.nameFields(header);
}

bool CsvReader::next() {
  if (!lines_.next()) return false;
  if (lines_.size() != columns_)
    lines_.fail(std::to_string(lines_.size()) + " fields where the header has " +
                std::to_string(columns_));
  return true;
}

}  // namespace mvo
