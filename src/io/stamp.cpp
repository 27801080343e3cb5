// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/stamp.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace mvo {

namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::size_t kMaxSecondsDigits = 9;  // fits into 64 bits of nanoseconds with room to spare
constexpr double kMaxSeconds = 9e9;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> parseScientific(const std::string& text) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !(std::abs(seconds) < kMaxSeconds)) return {};
  return std::llround(seconds * 1e9);
}

}  // namespace

std::string formatStamp(std::int64_t stamp_ns) {
  const std::int64_t magnitude = stamp_ns < 0 ? -stamp_ns : stamp_ns;
  char text[40];
  std::snprintf(text, sizeof(text), "%s%lld.%09lld", stamp_ns < 0 ? "-" : "",
                static_cast<long long>(magnitude / kNanosecondsPerSecond),
                static_cast<long long>(magnitude % kNanosecondsPerSecond));
  return text;
}

std::optional<std::int64_t> parseStamp(const std::string& text) {
  if (text.find_first_of("eE") != std::string::npos) return parseScientific(text);
  std::size_t i = 0;
  const bool negative = !text.empty() && text[0] == '-';
  if (negative) ++i;
  std::int64_t seconds = 0;
  const std::size_t first = i;
  for (; i < text.size() && isDigit(text[i]); ++i) {
    if (i - first > kMaxSecondsDigits) return {};
    seconds = 10 * seconds + (text[i] - '0');
  }
  std::size_t digits = i - first;
  std::int64_t nanoseconds = 0;
  if (i < text.size() && text[i] == '.') {
    std::int64_t unit = kNanosecondsPerSecond / 10;
    for (++i; i < text.size() && isDigit(text[i]); ++i, ++digits, unit /= 10) {
      if (unit == 0) {  // the tenth decimal rounds, the others cannot be kept
        if (text[i] >= '5') ++nanoseconds;
        while (i < text.size() && isDigit(text[i])) ++i;
        break;
      }
      nanoseconds += (text[i] - '0') * unit;
    }
  }
  if (digits == 0 || i != text.size() || seconds > static_cast<std::int64_t>(kMaxSeconds))
    return {};
  const std::int64_t stamp_ns = seconds * kNanosecondsPerSecond + nanoseconds;
  return negative ? -stamp_ns : stamp_ns;
}

}  // namespace mvo
