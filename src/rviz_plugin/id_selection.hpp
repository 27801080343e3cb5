// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which motions a person asks to see: a list of ids and ranges such as "1,3-5".
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mvo_rviz {

/// A set of ids; without any range it holds every id.
struct IdSelection {
  std::vector<std::pair<int, int>> ranges;  ///< first and last id of each, both included

  bool contains(int id) const;
};

/// A selection, or one sentence on why the text is none; then the selection holds every id.
struct ParsedIds {
  IdSelection ids;
  std::string problem;  ///< empty if the text was understood
};

/// Reads ids and ranges, separated by commas; spaces do not matter. Empty text selects every id.
ParsedIds parseIds(const std::string& text);

}  // namespace mvo_rviz
