// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The whole pipeline over a recording in memory: what each step costs once the window is full.
#pragma once

#include <algorithm>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mvo/odometry.hpp"
#include "support/measuring.hpp"
#include "support/rendered_sequence.hpp"

namespace mvo::test {

struct WarmSteps {
  std::vector<Cost> costs;  ///< per step
  std::vector<std::pair<std::string, std::vector<double>>>
      stages;                   ///< wall time per step [ms], in the order of the pipeline
  std::vector<double> motions;  ///< per step
  std::vector<double> points;   ///< of the window seen in the frame, per step
  double memory_mib = 0;        ///< at most, beyond what was there before

  std::vector<double>& stage(const std::string& name) {
    for (auto& [known, ms] : stages)
      if (known == name) return ms;
    return stages.emplace_back(name, std::vector<double>()).second;
  }
  std::vector<double> cpu() const { return each(&Cost::cpu_ms); }
  std::vector<double> wall() const { return each(&Cost::wall_ms); }

 private:
  std::vector<double> each(double Cost::*part) const {
    std::vector<double> values;
    for (const Cost& cost : costs) values.push_back(cost.*part);
    return values;
  }
};

/// All steps after the first full window. `between` is called after every step, outside of it.
inline WarmSteps warmSteps(const RenderedSequence& sequence, const Options& options, int threads,
                           const std::function<void()>& between) {
  WarmSteps out;
  cv::setNumThreads(threads);
  releaseFreeMemory();
  const double before = residentMebibytes();
  MultimotionOdometry odometry(sequence.camera, options);
  for (std::size_t k = 0; k < sequence.frames.size(); ++k) {
    MultimotionEstimate estimate;
    const Cost cost = costOf([&] { estimate = odometry.addFrame(sequence.frames[k]); });
    if (!estimate.problem.empty() && k > 0)
      throw std::runtime_error("frame " + std::to_string(k) + ": " + estimate.problem);
    between();
    out.memory_mib = std::max(out.memory_mib, residentMebibytes() - before);
    if (k < static_cast<std::size_t>(options.window.frames)) continue;
    out.costs.push_back(cost);
    out.motions.push_back(static_cast<double>(estimate.motions.size()));
    out.points.push_back(static_cast<double>(estimate.points.size()));
    for (const auto& [stage, ms] : estimate.timings_ms) out.stage(stage).push_back(ms);
  }
  return out;
}

}  // namespace mvo::test
