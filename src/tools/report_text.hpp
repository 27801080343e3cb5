// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How the lines of a report are put together.
#pragma once

#include <string>
#include <vector>

namespace mvo_tools {

/// printf to the end of a text; what is added has at most 511 characters.
[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...);

/// "1, 2, 5".
std::string listText(const std::vector<int>& ids);

}  // namespace mvo_tools
