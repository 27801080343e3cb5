// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/bag_cli.hpp"

#include <iostream>
#include <map>
#include <stdexcept>

namespace mvo_tools {

namespace {

constexpr char kDescription[] =
    "Runs multimotion visual odometry over a bag: every frame, no roscore, the same bytes each "
    "time.\n"
    "Writes camera.tum, motion_<id>.tum, labels.csv, timing.csv and summary.json.\n"
    "Example: rosrun mvo bag drive.bag --output results --overlay results/drive.mp4";

// Topics as given; 'empty' means the usual one.
struct GivenTopics {
  std::string left, left_info, right, right_info, color, color_info, depth;
};

// A given image topic has its camera_info beside it, as ROS drivers do, unless that is given too.
std::string besideIt(const std::string& image_topic) {
  const auto slash = image_topic.rfind('/');
  return (slash == std::string::npos ? "" : image_topic.substr(0, slash)) + "/camera_info";
}

void override(std::string& image, std::string& info, const std::string& given_image,
              const std::string& given_info) {
  if (!given_image.empty()) {
    image = given_image;
    info = besideIt(given_image);
  }
  if (!given_info.empty()) info = given_info;
}

mvo_ros::SensorTopics chosenTopics(mvo_ros::Sensor sensor, bool raw, const GivenTopics& given) {
  mvo_ros::SensorTopics topics = mvo_ros::usualTopics(sensor, raw);
  if (sensor == mvo_ros::Sensor::kRgbd) {
    if (!(given.left + given.left_info + given.right + given.right_info).empty())
      throw std::runtime_error(
          "--left, --left-info, --right and --right-info are for --input stereo, RGB-D has "
          "--color, "
          "--color-info and --depth");
    override(topics.left, topics.left_info, given.color, given.color_info);
    if (!given.depth.empty()) topics.second = given.depth;
  } else {
    if (!(given.color + given.color_info + given.depth).empty())
      throw std::runtime_error("--color, --color-info and --depth need --input rgbd");
    override(topics.left, topics.left_info, given.left, given.left_info);
    override(topics.second, topics.second_info, given.right, given.right_info);
  }
  return topics;
}

void addTopics(CLI::App& app, GivenTopics& given) {
  const auto add = [&app](const std::string& name, std::string& topic, const std::string& usual) {
    app.add_option(name, topic, "default " + usual)->type_name("TOPIC")->group("topics");
  };
  const auto stereo = mvo_ros::usualTopics(mvo_ros::Sensor::kStereo, false);
  const auto rgbd = mvo_ros::usualTopics(mvo_ros::Sensor::kRgbd, false);
  const std::string beside = ", or camera_info beside a given image topic";
  add("--left", given.left, stereo.left);
  add("--left-info", given.left_info, stereo.left_info + beside);
  add("--right", given.right, stereo.second);
  add("--right-info", given.right_info, stereo.second_info + beside);
  add("--color", given.color, rgbd.left);
  add("--color-info", given.color_info, rgbd.left_info + beside);
  add("--depth", given.depth, rgbd.second + " (16UC1 mm or 32FC1 m)");
}

void requireRange(const std::string& name, double value, double low, bool low_allowed) {
  if (value > low || (low_allowed && value == low)) return;
  throw std::runtime_error("option --" + name + " is '" + CLI::detail::to_string(value) +
                           "', it must be " + (low_allowed ? "at least " : "above ") +
                           CLI::detail::to_string(low) + " s");
}

void addOptions(CLI::App& app, BagCommand& command, std::string& input) {
  app.add_option("INPUT.bag", command.input, "the bag to read")->required()->type_name("");
  app.add_option("-o,--output", command.output, "folder to write; appears when all is done")
      ->required()
      ->type_name("DIR");
  app.add_flag("--force", command.force, "replace output of an earlier run");
  app.add_option("--input", input, "stereo or rgbd (default stereo)");
  app.add_flag("--raw", command.request.setup.raw,
               "take image_raw topics and rectify them here, by their camera_info");
  app.add_option("--start", command.request.start, "seconds after the first image to start at");
  app.add_option("--duration", command.request.duration, "seconds to read from there");
  app.add_option(
      "--sync-tolerance", command.request.sync_tolerance,
      "pair images whose stamps differ by up to so many seconds; default 0, equal stamps");
  app.add_option("--mask", command.mask,
                 "8-bit grey image of the (rectified) left image's size, 0 where nothing is to be "
                 "looked at: a hood, an arm, a logo")
      ->type_name("FILE");
  app.add_option("--camera-errors", command.camera_errors,
                 "what an earlier run learnt of the stereo pair's own error, to start from")
      ->type_name("FILE");
  app.add_option("--save-camera-errors", command.save_camera_errors,
                 "write what this run learnt of it (JSON)")
      ->type_name("FILE");
  app.add_flag("--smoothed", command.smoothed,
               "write the poses of the last window that contains a frame, not those known at its "
               "time");
  app.add_option("--overlay", command.overlay, "video of the labelled tracklets, e.g. run.mp4")
      ->type_name("FILE");
  app.add_option("--overlay-frames", command.overlay_frames, "the same as PNG files")
      ->type_name("DIR");
  app.add_flag("--yardstick", command.yardstick,
               "also measure this machine's Y (pyramidal LK of 1000 points) and report step / Y");
  app.add_option("--threads", command.threads,
                 "that share a step's work, 0 (default): one per processor; the results are the "
                 "same")
      ->type_name("N");
  app.add_flag("--quiet", command.quiet, "no progress bar, no notices");
}

// Errors of a pair need a pair that is not trusted.
void requirePair(const BagCommand& command) {
  for (const auto& [name, file] :
       {std::pair("--camera-errors", &command.camera_errors),
        std::pair("--save-camera-errors", &command.save_camera_errors)}) {
    if (file->empty()) continue;
    if (command.request.setup.sensor == mvo_ros::Sensor::kRgbd)
      throw std::runtime_error(std::string("option ") + name + " is for --input stereo");
    if (command.options.camera.errors == mvo::CameraErrorMode::kOff)
      throw std::runtime_error(std::string("option ") + name + " needs --camera.errors auto");
  }
}

}  // namespace

std::optional<BagCommand> parseBagCommand(int argc, const char* const* argv) {
  BagCommand command;
  GivenTopics topics;
  std::string input = "stereo";
  CLI::App app(kDescription, "bag");
  addOptions(app, command, input);
  app.set_version_flag("--version", MVO_VERSION);
  addTopics(app, topics);
  const OptionsCli options(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw std::runtime_error(error.what());
    if (options.tableWanted())
      std::cout << optionTableText();
    else
      app.exit(error);
    return std::nullopt;
  }
  if (input != "stereo" && input != "rgbd")
    throw std::runtime_error("option --input is '" + input + "', it must be stereo or rgbd");
  requireRange("start", command.request.start, 0, true);
  requireRange("duration", command.request.duration, 0, false);
  requireRange("sync-tolerance", command.request.sync_tolerance, 0, true);
  if (command.threads < 0)
    throw std::runtime_error("option --threads is '" + std::to_string(command.threads) +
                             "', it must be at least 0");
  const ChosenOptions chosen = options.chosen();
  if (!chosen.notice.empty() && !command.quiet) std::cerr << "bag: " << chosen.notice << '\n';
  command.options = chosen.options;
  command.profile = chosen.profile;
  command.request.setup.sensor =
      input == "rgbd" ? mvo_ros::Sensor::kRgbd : mvo_ros::Sensor::kStereo;
  command.request.setup.virtual_baseline = command.options.frontend.virtual_baseline;
  command.request.setup.topics =
      chosenTopics(command.request.setup.sensor, command.request.setup.raw, topics);
  requirePair(command);
  return command;
}

}  // namespace mvo_tools
