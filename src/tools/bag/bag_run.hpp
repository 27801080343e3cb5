// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the bag tool does, as a function.
#pragma once

#include <functional>

#include "tools/bag/bag_cli.hpp"

namespace mvo_tools {

/// Reads the bag, estimates every frame and writes all output at the end, or nothing: throws
/// std::exception with one sentence for bad input, for output that cannot be written, if no frame
/// has an estimate, and when `interrupted` says so (asked once per frame). A number of
/// threads is set for the whole process.
void runBag(const BagCommand& command, const std::function<bool()>& interrupted);

}  // namespace mvo_tools
