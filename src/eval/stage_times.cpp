// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/stage_times.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "statistics.hpp"

namespace mvo {

namespace {

constexpr const char* kTotal = "total";

StageTime statistics(std::string stage, std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  const double sum = std::accumulate(ms.begin(), ms.end(), 0.0);
  return {std::move(stage),   static_cast<int>(ms.size()),
          quantile(ms, 0.5),  sum / static_cast<double>(ms.size()),
          quantile(ms, 0.95), ms.back()};
}

}  // namespace

std::vector<StageTime> stageTimes(const std::vector<TimingRow>& rows) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> stages;
  std::map<std::int64_t, double> sums;
  std::map<std::int64_t, double> totals;
  for (const TimingRow& row : rows) {
    if (row.stage == kTotal) {
      totals[row.stamp_ns] = row.ms;
      continue;
    }
    if (stages.count(row.stage) == 0) order.push_back(row.stage);
    stages[row.stage].push_back(row.ms);
    sums[row.stamp_ns] += row.ms;
  }
  for (const auto& [stamp, ms] : totals) sums[stamp] = ms;
  std::vector<StageTime> times;
  times.reserve(order.size() + 1);
  for (const std::string& stage : order) times.push_back(statistics(stage, stages[stage]));
  if (sums.empty()) return times;
  std::vector<double> steps;
  steps.reserve(sums.size());
  for (const auto& [stamp, ms] : sums) steps.push_back(ms);
  times.push_back(statistics("step", std::move(steps)));
  return times;
}

}  // namespace mvo
