// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

namespace mvo_tools {

namespace {

constexpr std::size_t kBarWidth = 24;
constexpr auto kRecent = std::chrono::seconds(10);
constexpr auto kRedraw = std::chrono::milliseconds(100);

std::string duration(double seconds) {
  const auto whole = std::llround(seconds);
  char text[48];
  if (whole >= 3600)
    std::snprintf(text, sizeof(text), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  else
    std::snprintf(text, sizeof(text), "%lld:%02lld", whole / 60, whole % 60);
  return text;
}

}  // namespace

Progress::Progress(std::string what, std::string unit, std::size_t total, bool quiet)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (drawn_) std::cerr << '\n';
}

void Progress::update(std::size_t done) {
  if (quiet_ || total_ == 0) return;
  const auto now = Clock::now();
  if (recent_.empty()) recent_.emplace_back(start_, 0);
  recent_.emplace_back(now, done);
  while (recent_.size() > 2 && now - recent_.front().first > kRecent) recent_.pop_front();
  if (!terminal_) {
    const std::size_t tenths = std::min<std::size_t>(10 * done / total_, 10);
    if (tenths > tenths_) std::cerr << line(done) << std::endl;
    tenths_ = std::max(tenths, tenths_);
    return;
  }
  if (drawn_ && done < total_ && now - last_draw_ < kRedraw) return;
  last_draw_ = now;
  clearLine();
  std::cerr << line(done) << std::flush;
  drawn_ = true;
}

void Progress::message(const std::string& text) {
  clearLine();
  std::cerr << text << std::endl;
}

void Progress::clearLine() {
  if (drawn_) std::cerr << "\r\033[K";
  drawn_ = false;
}

std::string Progress::line(std::size_t done) const {
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  const auto now = Clock::now();
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const double span = seconds(now - recent_.front().first);
  const double rate =
      span > 0 ? (static_cast<double>(done) - static_cast<double>(recent_.front().second)) / span
               : 0;
  const auto filled = static_cast<std::size_t>(share * kBarWidth);
  char numbers[96];
  std::snprintf(numbers, sizeof(numbers), "] %3.0f %%  %zu/%zu %s  %.1f/s  ", 100 * share, done,
                total_, unit_.c_str(), rate);
  return what_ + " [" + std::string(filled, '#') + std::string(kBarWidth - filled, ' ') + numbers +
         (rate > 0 && done < total_ ? duration(static_cast<double>(total_ - done) / rate) + " left"
                                    : duration(seconds(now - start_)) + " taken");
}

}  // namespace mvo_tools
