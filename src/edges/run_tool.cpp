// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/run_tool.hpp"

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>

namespace mvo {

namespace {

constexpr int kSignalExitCode = 128;  // plus the signal's number

volatile std::sig_atomic_t signal_number = 0;

void onSignal(int number) { signal_number = number; }

}  // namespace

int runTool(const std::string& name, const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
  }
  return EXIT_FAILURE;
}

int runInterruptibleTool(const std::string& name,
                         const std::function<void(const Interrupted&)>& work) {
  signal_number = 0;
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  const int status = runTool(name, [&work] {
    work([] { return signal_number != 0; });
    return EXIT_SUCCESS;
  });
  return status != EXIT_SUCCESS && signal_number != 0 ? kSignalExitCode + signal_number : status;
}

}  // namespace mvo
