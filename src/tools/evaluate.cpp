// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun mvo evaluate ESTIMATE TRUTH: how good is a run, by the paper's measures and by those that
// are usual since.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "edges/run_tool.hpp"
#include "io/atomic_file.hpp"
#include "tools/bag_files.hpp"
#include "tools/evaluation_report.hpp"

namespace {

namespace fs = std::filesystem;

struct Command {
  std::string estimate;
  std::string truth;
  std::string json;
  std::string plot;
  std::string camera_alignment = "left";
  std::string frames = "all";
  bool quiet = false;
};

constexpr const char* kDescription =
    "Scores what 'rosrun mvo bag' wrote against the truth of its sequence: the errors after the\n"
    "paper's alignment by the first 25 poses, drift, per-frame errors, the number of motions,\n"
    "coverage, identities, labels and covariances. Prints a table of what the truth allows to "
    "tell.";

// None if the user only asked for help. Throws CLI::ParseError.
std::optional<Command> parse(int argc, char** argv) {
  Command command;
  CLI::App app(kDescription);
  app.name("evaluate");
  app.option_defaults()->always_capture_default();
  app.add_option("estimate", command.estimate,
                 "folder with camera.tum, motion_<id>.tum, labels.csv, timing.csv, covariances.csv")
      ->required();
  app.add_option("truth", command.truth,
                 "sequence folder (times.txt, truth/) or bag with truth topics (/truth/...)")
      ->required();
  app.add_option("--json", command.json, "write all figures and curves to this file");
  app.add_option("--plot", command.plot,
                 "draw error curves, motion counts and times into this folder");
  app.add_option("--camera-alignment", command.camera_alignment,
                 "left: the estimate is of the left optical frame; left-right: of another "
                 "camera-fixed frame")
      ->check(CLI::IsMember({"left", "left-right"}));
  app.add_option("--frames", command.frames,
                 "all: every true frame counts; estimate: only those between the first and the "
                 "last that the estimate has seen")
      ->check(CLI::IsMember({"all", "estimate"}));
  app.add_flag("--quiet", command.quiet, "no table");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return std::nullopt;
  }
  return command;
}

mvo::Truth readAnyTruth(const std::string& path) {
  if (!fs::exists(path)) throw std::runtime_error("there is no " + path);
  return fs::is_directory(path) ? mvo::readTruth(path) : mvo_tools::truthOfBag(path);
}

// What the bag tool noted about its run, if it did.
std::optional<nlohmann::ordered_json> readSummary(const fs::path& path) {
  if (!fs::exists(path)) return std::nullopt;
  std::ifstream file(path);
  try {
    return nlohmann::ordered_json::parse(file);
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read " + path.string() + ": " + error.what());
  }
}

void writeJson(const fs::path& path, const nlohmann::ordered_json& json) {
  mvo::AtomicFile file(path);
  file.stream() << json.dump(1) << '\n';
  file.commit();
}

// The plotting script lies beside this program.
void drawPlots(const fs::path& folder, const nlohmann::ordered_json& json) {
  fs::create_directories(folder);
  const fs::path figures = folder / "evaluation.json";
  writeJson(figures, json);
  const std::string script =
      fs::read_symlink("/proc/self/exe").parent_path() / "plot_evaluation.py";
  const std::string output = folder.string();
  const std::string input = figures.string();
  std::vector<char*> arguments;
  for (const std::string* text : {&script, &input})
    arguments.push_back(const_cast<char*>(text->c_str()));
  std::string option = "--output";
  arguments.push_back(option.data());
  arguments.push_back(const_cast<char*>(output.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, script.c_str(), nullptr, nullptr, arguments.data(), environ) != 0)
    throw std::runtime_error("cannot run " + script);
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("the plots were not drawn, their data are in " + input);
}

void evaluate(const Command& command) {
  const mvo::Estimate estimate = mvo::readEstimate(command.estimate);
  mvo::Truth truth = readAnyTruth(command.truth);
  if (command.frames == "estimate") truth = mvo::cropToEstimate(truth, estimate);
  mvo::EvaluationOptions options;
  if (command.camera_alignment == "left-right")
    options.camera_alignment = mvo::CameraAlignment::kLeftRight;
  const mvo::Evaluation evaluation = mvo::evaluate(estimate, truth, options);

  nlohmann::ordered_json json = {{"estimate", command.estimate},
                                 {"truth", command.truth},
                                 {"camera_alignment", command.camera_alignment}};
  json.update(mvo_tools::toJson(evaluation));
  if (const auto summary = readSummary(fs::path(command.estimate) / "summary.json"))
    json["run"] = *summary;
  if (!command.quiet) std::cout << mvo_tools::toTable(evaluation) << std::flush;
  if (!command.json.empty()) writeJson(command.json, json);
  if (!command.plot.empty()) drawPlots(command.plot, json);
}

}  // namespace

int main(int argc, char** argv) {
  return mvo::runTool("evaluate", [&] {
    if (const auto command = parse(argc, argv)) evaluate(*command);
    return EXIT_SUCCESS;
  });
}
