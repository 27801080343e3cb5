// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How the warm step's time grows with tracklets, frames and motions, one thread, CPU time. `engine`
// is the engine on synthetic windows, where the numbers are as asked for; `step` the whole step on
// simulated images, with as many features as asked for or as long a window, and for motions, which
// the front end does not know of, the engine's time on synthetic windows and that of the images'
// front end. Prints JSON; scripts/benchmark fits the exponents.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/warm_starts.hpp"
#include "support/warm_steps.hpp"
#include "support/window_of_motions.hpp"
#include "tools/yardstick.hpp"

namespace mvo {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  int steps = 24;  // measured per setting
  bool images = true;
};

constexpr int kWarmUp = 4;  // steps from the true labels to a steady state

Json engineTime(const test::WindowSize& size, int steps) {
  const test::SyntheticWindow scene = test::sceneOfMotions(size, kWarmUp + steps);
  Options options;
  options.window.frames = size.frames;
  test::WarmStarts starts;
  starts.remember(test::windowFrom(scene, 0, size), test::firstLabels(scene, size));
  std::vector<double> ms;
  std::vector<double> tracklets;
  std::vector<double> motions;
  for (int k = 0; k < kWarmUp + steps; ++k) {
    const Window window = test::windowFrom(scene, k, size);
    WarmStart start = starts.startOf(window);
    Segmentation found;
    const test::Cost cost = test::costOf(
        [&] { found = segmentMotions(window, scene.camera, std::move(start), options); });
    starts.remember(window, found);
    if (k < kWarmUp) continue;
    ms.push_back(cost.cpu_ms);
    tracklets.push_back(static_cast<double>(window.tracklets.size()));
    motions.push_back(static_cast<double>(found.labeling.labels.size()));
  }
  return {{"tracklets", test::median(tracklets)},
          {"frames", size.frames},
          {"motions", size.motions},
          {"motions_found", test::median(motions)},
          {"ms", test::median(ms)}};
}

Json stepTime(test::RenderedSequence sequence, const Options& options, int count) {
  sequence.frames.resize(static_cast<std::size_t>(options.window.frames) +
                         static_cast<std::size_t>(count));
  test::WarmSteps steps = test::warmSteps(sequence, options, 1, [] {});
  const double ms = test::median(steps.cpu());
  const double front_end =  // stages are in wall time
      (test::median(steps.stage("prepare")) + test::median(steps.stage("track"))) /
      test::median(steps.stage("total"));
  return {{"frames", options.window.frames},
          {"points", test::median(steps.points)},
          {"motions_found", test::median(steps.motions)},
          {"front_end_ms", front_end * ms},
          {"ms", ms}};
}

Json growth(const Settings& settings) {
  cv::setNumThreads(1);
  Json out;
  const auto along = [&out](const std::string& axis, const std::string& part, const Json& row) {
    std::cerr << axis << ", " << part << ": " << row.dump() << '\n';
    out[axis][part].push_back(row);
  };
  for (const int tracklets : {250, 1000, 4000})
    along("tracklets", "engine", engineTime({tracklets, 48, 5}, settings.steps));
  for (const int frames : {12, 48, 96}) {
    test::WindowSize size;
    size.frames = frames;
    along("frames", "engine", engineTime(size, settings.steps));
  }
  for (const int motions : {1, 5, 10})
    along("motions", "engine", engineTime({1000, 48, motions}, settings.steps));
  if (!settings.images) return out;

  const test::RenderedSequence sequence = test::renderBlocks(640, 480, 96 + settings.steps);
  const mvo_tools::YardstickPair pair(sequence.frames.front().left, sequence.frames.front().right);
  std::vector<double> rounds;
  const auto yardstick = [&] {
    for (int i = 0; i < 5; ++i) rounds.push_back(pair.round());
  };
  yardstick();
  for (const double factor : {0.25, 1.0, 4.0}) {  // as many points, at as much less distance
    Options options;
    options.frontend.max_features = static_cast<int>(options.frontend.max_features * factor);
    options.frontend.spacing /= std::sqrt(factor);
    along("tracklets", "step", stepTime(sequence, options, settings.steps));
    yardstick();
  }
  for (const int frames : {12, 48, 96}) {
    Options options;
    options.window.frames = frames;
    along("frames", "step", stepTime(sequence, options, settings.steps));
    yardstick();
  }
  const double front_end = out["tracklets"]["step"][1]["front_end_ms"];
  const Json engine = out["motions"]["engine"];
  for (Json row : engine) {
    row["ms"] = row["ms"].get<double>() + front_end;
    along("motions", "step", row);
  }
  out["Y_ms"] = test::quantile(rounds, 0);
  return out;
}

int run(int argc, char** argv) {
  Settings settings;
  CLI::App app(
      "Times the warm step over tracklets, frames and motions; JSON goes to the standard "
      "output.");
  app.name("growth_benchmark");
  app.option_defaults()->always_capture_default();
  app.add_option("--steps", settings.steps, "measured per setting")->check(CLI::Range(1, 10000));
  app.add_flag("!--no-images", settings.images, "the engine alone");
  CLI11_PARSE(app, argc, argv);
  std::cout << Json{{"growth", growth(settings)}}.dump(2) << std::endl;
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace mvo

int main(int argc, char** argv) {
  try {
    return mvo::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "growth_benchmark: " << error.what() << '\n';
  }
  return EXIT_FAILURE;
}
