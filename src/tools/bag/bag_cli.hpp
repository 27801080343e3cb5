// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The command line of the bag tool.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "ros/bag/bag_frames.hpp"
#include "tools/bag/options_cli.hpp"

namespace mvo_tools {

/// What `bag` was asked to do.
struct BagCommand {
  std::string input;
  std::string output;
  mvo_ros::BagRequest request;
  mvo::Options options;
  std::string profile;
  bool force = false;
  bool smoothed = false;
  bool yardstick = false;
  bool quiet = false;
  int threads = 0;                 ///< 0: one per processor
  std::string mask;                ///< an image file; empty: none
  std::string camera_errors;       ///< file to start from; empty: none
  std::string save_camera_errors;  ///< file to write; empty: none
  std::string overlay;
  std::string overlay_frames;
};

/// Parses the command line; none if it asked for help, the version or the table of options, which
/// are then printed to stdout. Throws std::exception with one sentence.
std::optional<BagCommand> parseBagCommand(int argc, const char* const* argv);

}  // namespace mvo_tools
