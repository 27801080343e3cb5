// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Between the callbacks and the work: at most a bounded number of frames wait.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace mvo_ros {

/// A queue of which the oldest items are dropped, and counted, beyond a limit: 1 keeps the newest
/// only. Safe from any thread.
template <class Item>
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t limit) : limit_(limit) {}

  void push(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      items_.push_back(std::move(item));
      while (items_.size() > limit_) {
        items_.pop_front();
        ++dropped_;
      }
    }
    changed_.notify_all();
  }

  /// Waits for room instead of dropping.
  void pushInTurn(Item item) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return closed_ || items_.size() < limit_; });
      if (closed_) return;
      items_.push_back(std::move(item));
    }
    changed_.notify_all();
  }

  /// Waits for an item; none once closed.
  std::optional<Item> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (closed_) return std::nullopt;
    std::optional<Item> item(std::move(items_.front()));
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  /// Forgets what waits, uncounted.
  void clear() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      items_.clear();
    }
    changed_.notify_all();
  }

  /// Wakes pop() for good.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

  bool closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }
  std::uint64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  const std::size_t limit_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace mvo_ros
