// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Time stamps in text files: decimal seconds outside, whole nanoseconds inside, exact both ways.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace mvo {

/// "seconds.nanoseconds" with nine decimals; parseStamp gives back the same number.
std::string formatStamp(std::int64_t stamp_ns);

/// Nanoseconds of decimal seconds. Plain decimals are exact (digits after the ninth are rounded);
/// an exponent, as KITTI writes it, goes through double. None if it is not a number or too large.
std::optional<std::int64_t> parseStamp(const std::string& text);

}  // namespace mvo
