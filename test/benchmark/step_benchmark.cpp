// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The whole step on simulated images, warm and cold, on one thread and on two, and in the same
// run the yardstick Y that its times are measured in. Prints JSON; scripts/benchmark makes tables
// of it.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mvo/segment_motions.hpp"
#include "support/tracked_window.hpp"
#include "support/warm_steps.hpp"
#include "tools/yardstick.hpp"

namespace mvo {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  std::vector<std::string> sizes{"640x480", "1241x376", "1280x960"};
  int frames = 152;  // of which all but the window's are measured
  int cold = 8;
  bool yardstick = false;  // and nothing else
};

// Best of rounds that take turns with what is measured.
class Yardstick {
 public:
  explicit Yardstick(const test::RenderedSequence& sequence) {
    const auto& frames = sequence.frames;
    for (const std::size_t k : {std::size_t{0}, frames.size() / 2, frames.size() - 1})
      pairs_.emplace_back(frames[k].left, frames[k].right);
  }
  void rounds(int count) {
    for (int i = 0; i < count; ++i)
      for (const auto& pair : pairs_) rounds_ms_.push_back(pair.round());
  }
  double best() const { return test::quantile(rounds_ms_, 0); }
  double median() const { return test::median(rounds_ms_); }

 private:
  std::vector<mvo_tools::YardstickPair> pairs_;
  std::vector<double> rounds_ms_;
};

Json summary(const std::vector<double>& ms) {
  return {{"median", test::median(ms)}, {"p99", test::quantile(ms, 0.99)}};
}

template <class Stages>
Json mediansOf(const Stages& stages) {
  Json medians;
  for (const auto& [stage, ms] : stages) medians[stage] = test::median(ms);
  return medians;
}

Json summary(const test::WarmSteps& steps) {
  return {{"steps", steps.costs.size()},
          {"cpu_ms", summary(steps.cpu())},
          {"wall_ms", summary(steps.wall())},
          {"stages_ms", mediansOf(steps.stages)}};
}

// A full window's newest frame, with nothing known but the tracklets: that frame's front end and
// the engine without a start. So costly is no step of a running odometry, whose window grows.
Json coldSteps(const test::RenderedSequence& sequence, const Options& options, int count,
               int threads, Yardstick& yardstick) {
  cv::setNumThreads(threads);
  test::TrackedWindow tracked(sequence.camera, options);
  const auto full = static_cast<std::size_t>(options.window.frames) - 1;
  const std::size_t every = std::max<std::size_t>(1, (sequence.frames.size() - full) / count);
  std::vector<double> cpu;
  std::vector<double> wall;
  std::vector<double> tracklets;
  std::vector<double> observations;
  std::vector<double> motions;
  std::map<std::string, std::vector<double>> stages;
  for (std::size_t k = 0; k < full + every * (count - 1) + 1 && k < sequence.frames.size(); ++k) {
    test::Cost cost = test::costOf([&] { tracked.add(sequence.frames[k]); });
    if (k < full || (k - full) % every != 0) continue;
    Segmentation found;
    const test::Cost engine = test::costOf(
        [&] { found = segmentMotions(tracked.window(), sequence.camera, {}, options); });
    cpu.push_back(cost.cpu_ms + engine.cpu_ms);
    wall.push_back(cost.wall_ms + engine.wall_ms);
    tracklets.push_back(static_cast<double>(tracked.window().tracklets.size()));
    for (const auto& [stage, ms] : found.timings_ms) stages[stage].push_back(ms);
    observations.push_back(static_cast<double>(test::observationsIn(tracked.window())));
    motions.push_back(static_cast<double>(found.labeling.labels.size()));
    yardstick.rounds(1);
  }
  return {{"steps", cpu.size()},
          {"cpu_ms", summary(cpu)},
          {"wall_ms", summary(wall)},
          {"stages_ms", mediansOf(stages)},
          {"tracklets", test::median(tracklets)},
          {"observations", test::median(observations)},
          {"motions", test::median(motions)}};
}

test::RenderedSequence rendered(const std::string& size, int frames) {
  return test::renderBlocks(std::stoi(size), std::stoi(size.substr(size.find('x') + 1)), frames);
}

Json yardstickAlone(const Settings& settings) {
  Json out;
  for (const std::string& size : settings.sizes) {
    Yardstick yardstick(rendered(size, 3));
    yardstick.rounds(5);
    out[size] = yardstick.best();
  }
  return {{"Y_ms", out}};
}

Json measured(const std::string& size, const Settings& settings) {
  const Options options;
  std::cerr << size << ": renders " << settings.frames << " frames\n";
  const test::RenderedSequence sequence = rendered(size, settings.frames);
  Yardstick yardstick(sequence);
  yardstick.rounds(3);
  Json out = {{"size", size}, {"window_frames", options.window.frames}};
  const std::array<std::pair<const char*, int>, 2> kThreads{
      {{"one_thread", 1}, {"two_threads", 2}}};
  for (const auto& [name, threads] : kThreads) {
    std::cerr << size << ": warm steps, " << name << '\n';
    int step = 0;
    const test::WarmSteps steps = test::warmSteps(sequence, options, threads, [&] {
      if (++step % 8 == 0) yardstick.rounds(1);
    });
    out["warm"][name] = summary(steps);
    out["warm"][name]["motions"] = test::median(steps.motions);
    out["warm"][name]["points"] = test::median(steps.points);
    out["warm"][name]["memory_mib"] = steps.memory_mib;
  }
  for (const auto& [name, threads] : kThreads) {
    std::cerr << size << ": cold steps, " << name << '\n';
    out["cold"][name] = coldSteps(sequence, options, settings.cold, threads, yardstick);
  }
  out["Y_ms"] = yardstick.best();
  out["Y_median_ms"] = yardstick.median();
  return out;
}

// Empty if a word is an image size.
std::string sizeComplaint(const std::string& word) {
  const std::size_t cross = word.find('x');
  const auto number = [](const std::string& s) {
    return !s.empty() && s.size() < 6 && s.find_first_not_of("0123456789") == std::string::npos;
  };
  return cross != std::string::npos && number(word.substr(0, cross)) &&
                 number(word.substr(cross + 1))
             ? ""
             : "'" + word + "' is not a size like 640x480";
}

int run(int argc, char** argv) {
  Settings settings;
  CLI::App app("Times the whole step on simulated images; JSON goes to the standard output.");
  app.name("step_benchmark");
  app.option_defaults()->always_capture_default();
  app.add_option("--size", settings.sizes, "of the images")->check(sizeComplaint);
  app.add_option("--frames", settings.frames, "per size; the window's 48 are not measured")
      ->check(CLI::Range(50, 100000));
  app.add_option("--cold", settings.cold, "cold steps per size")->check(CLI::Range(1, 1000));
  app.add_flag("--yardstick", settings.yardstick, "the yardstick alone");
  CLI11_PARSE(app, argc, argv);
  if (settings.yardstick) {
    std::cout << yardstickAlone(settings).dump(2) << std::endl;
    return EXIT_SUCCESS;
  }
  Json out = Json::array();
  for (const std::string& size : settings.sizes) out.push_back(measured(size, settings));
  std::cout << Json{{"step", out}}.dump(2) << std::endl;
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace mvo

int main(int argc, char** argv) {
  try {
    return mvo::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "step_benchmark: " << error.what() << '\n';
  }
  return EXIT_FAILURE;
}
