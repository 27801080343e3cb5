// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/id_selection.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>

namespace mvo_rviz {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto isSpace = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

// Spaces may stand around a number, never inside it: "1 2" is a forgotten comma, not 12.
std::optional<int> parseId(std::string_view text) {
  text = trimmed(text);
  int id = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, id);
  if (error != std::errc() || stop != end || id < 0) return std::nullopt;
  return id;
}

std::optional<std::pair<int, int>> parseRange(std::string_view text) {
  const std::size_t dash = text.find('-');
  const std::optional<int> first = parseId(text.substr(0, dash));
  const std::optional<int> last =
      dash == std::string_view::npos ? first : parseId(text.substr(dash + 1));
  if (!first || !last || *last < *first) return std::nullopt;
  return std::make_pair(*first, *last);
}

ParsedIds notUnderstood(std::string_view item) {
  const std::string what = item.empty() ? "an empty entry" : '\'' + std::string(item) + '\'';
  return {{}, what + " is no id and no range of ids as in 1,3-5; all motions are shown."};
}

}  // namespace

bool IdSelection::contains(int id) const {
  return ranges.empty() || std::any_of(ranges.begin(), ranges.end(), [&](const auto& range) {
           return range.first <= id && id <= range.second;
         });
}

ParsedIds parseIds(const std::string& text) {
  ParsedIds out;
  std::string_view rest = text;
  if (trimmed(rest).empty()) return out;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    const auto range = parseRange(item);
    if (!range) return notUnderstood(trimmed(item));
    out.ids.ranges.push_back(*range);
    if (comma == std::string_view::npos) return out;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace mvo_rviz
