// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo bag INPUT.bag --output DIR: a bag of stereo or RGB-D images to the trajectories of the
// camera and of everything that moves.
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "tools/bag/bag_cli.hpp"
#include "tools/bag/bag_run.hpp"

namespace {

constexpr int kSignalExitCode = 128;  // plus the signal's number, as shells report it

volatile std::sig_atomic_t signal_number = 0;

void onSignal(int number) { signal_number = number; }

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  try {
    const auto command = mvo_tools::parseBagCommand(argc, argv);
    if (command) mvo_tools::runBag(*command, [] { return signal_number != 0; });
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "bag: " << error.what() << '\n';
  }
  return signal_number != 0 ? kSignalExitCode + signal_number : EXIT_FAILURE;
}
