// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo simulate SCENE (--bag FILE | --folder DIR): images of a scene with exact truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <future>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <thread>

#include "edges/run_tool.hpp"
#include "mvo/sim.hpp"
#include "tools/bag_files.hpp"
#include "tools/progress.hpp"
#include "tools/staged_output.hpp"

namespace {

struct Command {
  std::string scene;
  std::string bag;
  std::string folder;
  int frames = 300;
  std::uint64_t seed = 1;
  bool force = false;
  bool quiet = false;
  mvo::sim::SceneOptions options;
};

std::string sceneHelp() {
  std::string help = "one of";
  for (const std::string& name : mvo::sim::sceneNames())
    help += "\n" + name + ": " + mvo::sim::sceneSummary(name);
  return help;
}

// What makes the cameras other than the calibration, which stays that of the exact pair.
void addImperfections(CLI::App& app, mvo::sim::Imperfections& imperfections) {
  for (const mvo::OptionEntry& row : mvo::sim::optionTable(imperfections)) {
    const std::string unit = row.unit.empty() ? "" : " [" + row.unit + "]";
    app.add_option_function<std::string>("--" + row.name, row.set, row.help + unit)
        ->default_str(row.get())
        ->type_name(row.range)
        ->group("Imperfections, none of which is in the calibration");
  }
}

// Size and rate as given, otherwise those of the scene.
struct Format {
  std::optional<int> width;
  std::optional<int> height;
  std::optional<double> rate_hz;

  void add(CLI::App& app) {
    app.add_option("--rate", rate_hz, "frames per second [Hz], otherwise the scene's: 15 (10)");
    app.add_option("--width", width, "of the images [px], otherwise the scene's: 640 (1241)");
    app.add_option("--height", height, "of the images [px], otherwise the scene's: 480 (376)");
  }
  void apply(const std::string& scene, mvo::sim::SceneOptions& options) const {
    const mvo::sim::SceneOptions usual = mvo::sim::usualOptions(scene);
    options.width = width.value_or(usual.width);
    options.height = height.value_or(usual.height);
    options.rate_hz = rate_hz.value_or(usual.rate_hz);
  }
};

// None if the user only asked for help. Throws CLI::ParseError.
std::optional<Command> parse(int argc, char** argv) {
  Command command;
  mvo::sim::SceneOptions& options = command.options;
  Format format;
  CLI::App app("Renders a scene whose every motion is known, as a bag or as a folder.");
  app.name("simulate");
  app.get_formatter()->column_width(32);
  app.option_defaults()->always_capture_default();
  app.add_option("scene", command.scene, sceneHelp())->required()->capture_default_str();
  auto* outputs = app.add_option_group("output", "where to write, exactly one of");
  outputs->add_option("--bag", command.bag, "a bag with the usual topics and truth topics");
  outputs->add_option("--folder", command.folder, "a folder of PNG images and text files");
  outputs->require_option(1);
  app.add_option("--frames", command.frames, "number of frames")->check(CLI::Range(1, 1000000));
  format.add(app);
  app.add_option("--seed", command.seed, "another seed, other textures, layout and motions");
  app.add_flag("--rgbd", options.rgbd, "colour image and depth instead of a stereo pair");
  app.add_option("--noise", options.noise, "standard deviation of a pixel [grey levels]");
  app.add_option("--gain", options.gain, "brightness of the right image relative to the left");
  app.add_option("--blur", options.blur, "exposure time as a share of the frame period");
  addImperfections(app, options.imperfections);
  app.add_flag("--force", command.force, "replace an existing output");
  app.add_flag("--quiet", command.quiet, "no progress bar");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return std::nullopt;
  }
  format.apply(command.scene, options);
  return command;
}

// Renders ahead on all cores and hands the frames over in order.
void renderAll(const mvo::sim::Scene& scene, const Command& command, const std::string& what,
               const mvo_tools::SequenceSink& sink, const mvo::Interrupted& interrupted) {
  const int ahead = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  mvo_tools::Progress progress(what, "frames", static_cast<std::size_t>(command.frames),
                               command.quiet);
  for (int first = 0; first < command.frames; first += ahead) {
    std::vector<std::future<mvo::SequenceFrame>> batch;
    for (int frame = first; frame < std::min(first + ahead, command.frames); ++frame) {
      batch.push_back(std::async(std::launch::async, [&scene, frame] {
        return mvo::sim::toSequenceFrame(mvo::sim::render(scene, frame));
      }));
    }
    for (auto& rendered : batch) sink.add(rendered.get());
    progress.update(static_cast<std::size_t>(first) + batch.size());
    if (interrupted()) throw std::runtime_error("interrupted, nothing was written");
  }
}

void simulate(const Command& command, const mvo::Interrupted& interrupted) {
  using mvo_tools::StagedOutput;
  const bool to_bag = !command.bag.empty();
  const std::string target = to_bag ? command.bag : command.folder;
  StagedOutput output(target, to_bag ? StagedOutput::Kind::kFile : StagedOutput::Kind::kFolder,
                      command.force, to_bag ? "" : "calib.json");
  const auto scene = mvo::sim::makeScene(command.scene, command.seed, command.options);
  const mvo::SequenceInfo info = mvo::sim::sequenceInfo(scene);
  const auto sink = to_bag ? mvo_tools::bagSink(output.path().string(), info)
                           : mvo_tools::folderSink(output.path(), info);
  renderAll(scene, command, target, sink, interrupted);
  sink.finish();
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return mvo::runInterruptibleTool("simulate", [&](const mvo::Interrupted& interrupted) {
    if (const auto command = parse(argc, argv)) simulate(*command, interrupted);
  });
}
