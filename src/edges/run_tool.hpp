// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the main() of every program does around its work.
#pragma once

#include <functional>
#include <string>

namespace mvo {

/// Runs a program's work, which returns its exit status. What the work throws becomes one sentence,
/// "name: ...", on the standard error, and a failure. Returns the exit status.
int runTool(const std::string& name, const std::function<int()>& work);

/// True once SIGINT or SIGTERM came.
using Interrupted = std::function<bool()>;

/// The same for work that a signal may end: it asks now and then and throws if so. The status is
/// then 128 and the signal's number, as shells report it.
int runInterruptibleTool(const std::string& name,
                         const std::function<void(const Interrupted&)>& work);

}  // namespace mvo
