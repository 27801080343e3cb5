// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo import_dataset KIND PATH (--bag FILE | --folder DIR): a published recording with its
// truth, where that is known.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "edges/run_tool.hpp"
#include "mvo/sequence.hpp"
#include "tools/bag_files.hpp"
#include "tools/progress.hpp"
#include "tools/staged_output.hpp"

namespace {

struct Command {
  std::string kind;
  std::string path;
  std::string bag;
  std::string folder;
  std::size_t first = 0;
  std::size_t count = 0;
  mvo::OxfordOptions oxford;
  std::string calibration;
  std::string vicon_calibration;
  bool force = false;
  bool quiet = false;
};

constexpr const char* kDescription =
    "Turns a recording into a bag or a sequence folder: rectified images, calibration and truth.\n"
    "  sequence  calib.json, times.txt, left/ right/ or rgb/ depth/, truth/ (as 'simulate "
    "--folder')\n"
    "  kitti     a KITTI odometry sequence: image_0/ image_1/ calib.txt times.txt, poses.txt in it "
    "or\n"
    "            in ../../poses\n"
    "  oxford    a segment of the Oxford Multimotion Dataset: stereo.csv, "
    "NNNNNN_{left,right}.png,\n"
    "            vicon.csv; kalibr*.yaml (or manufacturer*.yaml) and vicon*.yaml at or above it.\n"
    "            Its clocks are not synchronized: see --vicon-offset";

// None if the user only asked for help. Throws CLI::ParseError.
std::optional<Command> parse(int argc, char** argv) {
  Command command;
  CLI::App app(kDescription);
  app.name("import_dataset");
  app.option_defaults()->always_capture_default();
  app.add_option("kind", command.kind, "layout of the recording")
      ->required()
      ->check(CLI::IsMember({"sequence", "kitti", "oxford"}))
      ->capture_default_str();
  app.add_option("path", command.path, "folder of the recording")->required();
  auto* outputs = app.add_option_group("output", "where to write, exactly one of");
  outputs->add_option("--bag", command.bag, "a bag with the usual topics and truth topics");
  outputs->add_option("--folder", command.folder, "a sequence folder of PNG images and text files");
  outputs->require_option(1);
  app.add_option("--first", command.first, "skip the frames before this one");
  app.add_option("--count", command.count, "write so many frames, 0 = all");
  app.add_flag("--force", command.force, "replace an existing output");
  app.add_flag("--quiet", command.quiet, "no progress bar");
  app.add_option("--calibration", command.calibration, "Kalibr file of the stereo camera")
      ->group("oxford");
  app.add_option("--vicon-calibration", command.vicon_calibration, "file with T_apparatus_left")
      ->group("oxford");
  app.add_option("--apparatus", command.oxford.apparatus, "name of the camera in vicon.csv")
      ->group("oxford");
  app.add_option("--vicon-offset", command.oxford.vicon_offset,
                 "added to the stamps of vicon.csv [s]")
      ->group("oxford");
  app.add_flag("--rectified", command.oxford.rectified,
               "the images are rectified, whatever the calibration says")
      ->group("oxford");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return std::nullopt;
  }
  command.oxford.calibration = command.calibration;
  command.oxford.vicon_calibration = command.vicon_calibration;
  return command;
}

mvo::SequenceSource open(const Command& command) {
  if (command.kind == "kitti") return mvo::openKitti(command.path);
  if (command.kind == "oxford") return mvo::openOxford(command.path, command.oxford);
  return mvo::openSequenceFolder(command.path);
}

void import(const Command& command, const mvo::Interrupted& interrupted) {
  const mvo::SequenceSource source = open(command);
  if (command.first >= source.frames)
    throw std::runtime_error("option --first is '" + std::to_string(command.first) +
                             "', the recording has " + std::to_string(source.frames) + " frames");
  const std::size_t left = source.frames - command.first;
  const std::size_t count = command.count == 0 ? left : std::min(command.count, left);
  using mvo_tools::StagedOutput;
  const bool to_bag = !command.bag.empty();
  const std::string target = to_bag ? command.bag : command.folder;
  StagedOutput output(target, to_bag ? StagedOutput::Kind::kFile : StagedOutput::Kind::kFolder,
                      command.force, to_bag ? "" : "calib.json");
  const auto sink = to_bag ? mvo_tools::bagSink(output.path().string(), source.info)
                           : mvo_tools::folderSink(output.path(), source.info);
  mvo_tools::Progress progress(target, "frames", count, command.quiet);
  for (std::size_t k = 0; k < count; ++k) {
    sink.add(source.frame(command.first + k));
    progress.update(k + 1);
    if (interrupted()) throw std::runtime_error("interrupted, nothing was written");
  }
  sink.finish();
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return mvo::runInterruptibleTool("import_dataset", [&](const mvo::Interrupted& interrupted) {
    if (const auto command = parse(argc, argv)) import(*command, interrupted);
  });
}
