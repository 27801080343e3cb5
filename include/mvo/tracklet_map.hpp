// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of each tracklet.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "mvo/types.hpp"

namespace mvo {

/// Values by tracklet, sorted by id in one piece of memory: windows list their tracklets by id, so
/// filling one is appending. Used like a std::map; setting a value invalidates iterators.
template <class T>
class TrackletMap {
 public:
  using Entry = std::pair<TrackletId, T>;
  using const_iterator = typename std::vector<Entry>::const_iterator;

  const_iterator begin() const { return entries_.begin(); }
  const_iterator end() const { return entries_.end(); }
  const_iterator find(TrackletId id) const {
    const auto it = std::lower_bound(entries_.begin(), entries_.end(), id, before);
    return it != entries_.end() && it->first == id ? it : entries_.end();
  }

  /// Constant time if no larger id has been set.
  void set(TrackletId id, T value) {
    if (entries_.empty() || entries_.back().first < id) {
      entries_.emplace_back(id, std::move(value));
      return;
    }
    const auto it = std::lower_bound(entries_.begin(), entries_.end(), id, before);
    if (it->first == id)
      it->second = std::move(value);
    else
      entries_.insert(it, {id, std::move(value)});
  }

  void clear() { entries_.clear(); }
  void reserve(std::size_t entries) { entries_.reserve(entries); }
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }

 private:
  static bool before(const Entry& entry, TrackletId id) { return entry.first < id; }

  std::vector<Entry> entries_;
};

}  // namespace mvo
