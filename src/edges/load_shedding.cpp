// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/load_shedding.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "statistics.hpp"

namespace mvo_ros {

namespace {

constexpr std::size_t kArrivals = 16;
constexpr std::size_t kFewArrivals = 4;

// In frame periods.
constexpr double kTooLong = 0.85;
constexpr double kAim = 0.7;
constexpr double kRoom = 0.6;  // kRoom * kRaise is well below kTooLong
constexpr double kBudget = 0.8;

constexpr std::size_t kJudged = 7;     // steps, of which most must be too long
constexpr std::size_t kSettling = 4;   // steps after a change before the next are judged
constexpr std::size_t kPatience = 30;  // steps, of which nearly all must have room
constexpr std::size_t kExcused = 3;    // of them
constexpr double kRaise = 1.1;
constexpr double kMostShed = 0.6;  // shares left at once
constexpr double kLeastShed = 0.95;
constexpr double kLeastBudget = 1;  // ms

}  // namespace

void FramePeriod::add(double stamp, double clock, double wall) {
  if (!arrivals_.empty() && stamp == arrivals_.back().stamp) return;
  if (!arrivals_.empty() && stamp < arrivals_.back().stamp) arrivals_.clear();
  arrivals_.push_back({stamp, clock, wall});
  if (arrivals_.size() > kArrivals) arrivals_.pop_front();
}

std::optional<double> FramePeriod::seconds() const {
  if (arrivals_.size() < kFewArrivals) return std::nullopt;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < arrivals_.size(); ++i)
    intervals.push_back(arrivals_[i].stamp - arrivals_[i - 1].stamp);
  const double clock = arrivals_.back().clock - arrivals_.front().clock;
  const double wall = arrivals_.back().wall - arrivals_.front().wall;
  return mvo::median(intervals) * (clock > 0 && wall > 0 ? wall / clock : 1.0);
}

void LoadShedding::step(double step_ms, double period_ms, int most) {
  loads_.push_back(step_ms / period_ms);
  if (loads_.size() > kPatience + kSettling) loads_.pop_front();
  if (loads_.size() < kJudged + kSettling) return;
  const double load =
      mvo::median<double>({loads_.end() - static_cast<std::ptrdiff_t>(kJudged), loads_.end()});
  const int now = features(most);
  const int fewest = std::min(kFewest, most);
  if (load > kTooLong) {
    if (now > fewest) {
      const double share = std::clamp(kAim / load, kMostShed, kLeastShed);
      features_ = std::max(fewest, static_cast<int>(share * now));
    } else {
      limits_time_ = true;
    }
    loads_.clear();
    return;
  }
  const auto busy = static_cast<std::size_t>(
      std::count_if(loads_.begin(), loads_.end(), [](double l) { return l > kRoom; }));
  if (loads_.size() < kPatience + kSettling || busy > kExcused) return;
  if (limits_time_) {
    limits_time_ = false;
  } else if (features_) {
    const int more = static_cast<int>(std::ceil(kRaise * now));
    features_ = more < most ? std::make_optional(more) : std::nullopt;
  } else {
    return;
  }
  loads_.clear();
}

int LoadShedding::features(int most) const { return features_ ? std::min(*features_, most) : most; }

double LoadShedding::budget(double period_ms, double outside_ms) const {
  if (!limits_time_) return 0;
  return std::max(kLeastBudget, std::round(kBudget * period_ms - outside_ms));
}

}  // namespace mvo_ros
