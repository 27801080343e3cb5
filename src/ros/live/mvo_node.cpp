// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo mvo_node [stereo|rgbd]: the live node without a nodelet manager.
#include <ros/ros.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "edges/run_tool.hpp"
#include "ros/live/live_node.hpp"
#include "ros/parameters/parameters.hpp"

int main(int argc, char** argv) {
  return mvo::runTool("mvo_node", [&] {
    std::string input = "stereo";
    std::string profile;
    CLI::App app(
        "Finds every rigid motion in live images; topics and parameters are in the README.");
    app.name("mvo_node");
    app.add_option("input", input, "stereo (default) or rgbd")
        ->check(CLI::IsMember({"stereo", "rgbd"}));
    app.add_option(
        "--yaml", profile,
        "print all parameters of a profile (default, paper) as config/mvo.yaml has them, "
        "and exit");
    // Before ros::init, which needs a home to log to: help needs none.
    std::vector<std::string> words;
    ros::removeROSArgs(argc, argv, words);
    try {
      app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));  // last first
    } catch (const CLI::ParseError& error) {
      return app.exit(error);
    }
    if (!profile.empty()) {
      std::cout << mvo_ros::parametersYaml(profile);
      return EXIT_SUCCESS;
    }
    ros::init(argc, argv, "mvo");
    const auto sensor = input == "rgbd" ? mvo_ros::Sensor::kRgbd : mvo_ros::Sensor::kStereo;
    const ros::NodeHandle nh;
    const ros::NodeHandle pnh("~");
    const mvo_ros::LiveNode node(sensor, nh, pnh);
    ros::MultiThreadedSpinner(2).spin();
    return EXIT_SUCCESS;
  });
}
