// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo bag INPUT.bag --output DIR: a bag of stereo or RGB-D images to the trajectories of the
// camera and of everything that moves.
#include "edges/run_tool.hpp"
#include "tools/bag/bag_cli.hpp"
#include "tools/bag/bag_run.hpp"

int main(int argc, char** argv) {
  return mvo::runInterruptibleTool("bag", [&](const mvo::Interrupted& interrupted) {
    const auto command = mvo_tools::parseBagCommand(argc, argv);
    if (command) mvo_tools::runBag(*command, interrupted);
  });
}
