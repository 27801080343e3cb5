// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where a window's tracklets are in the left image, frame by frame, in flat arrays.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "mvo/types.hpp"

namespace mvo {

/// A position in the left image [px]; NaN where a tracklet is not seen.
struct ImagePoint {
  float u = 0;
  float v = 0;
  float distance2(const ImagePoint& other) const {
    return (u - other.u) * (u - other.u) + (v - other.v) * (v - other.v);
  }
  bool isFinite() const { return std::isfinite(u) && std::isfinite(v); }
};

/// Of positions [px]; empty at first.
struct ImageBox {
  float left = std::numeric_limits<float>::max();
  float right = std::numeric_limits<float>::lowest();
  float top = std::numeric_limits<float>::max();
  float bottom = std::numeric_limits<float>::lowest();

  static ImageBox around(const ImagePoint& p) { return {p.u, p.u, p.v, p.v}; }
  ImageBox grownBy(float margin) const {
    return {left - margin, right + margin, top - margin, bottom + margin};
  }
  void add(const ImageBox& other) {
    left = std::min(left, other.left);
    right = std::max(right, other.right);
    top = std::min(top, other.top);
    bottom = std::max(bottom, other.bottom);
  }
};

/// Frames count from the window's first.
class ImagePaths {
 public:
  explicit ImagePaths(const Window& window);

  int tracklets() const { return static_cast<int>(first_.size()); }
  int frames() const { return frames_; }
  std::size_t positions() const { return u_.size(); }  ///< of all, at most
  const ImageBox& extent() const { return extent_; }   ///< of all finite positions
  bool hasGaps(int tracklet) const { return gaps_[tracklet] != 0; }
  int first(int tracklet) const { return first_[tracklet]; }
  int last(int tracklet) const { return last_[tracklet]; }
  /// At any frame from the tracklet's first to its last; NaN in a gap.
  ImagePoint at(int tracklet, int frame) const {
    const std::size_t i = begin_[tracklet] + frame - first_[tracklet];
    return {u_[i], v_[i]};
  }
  /// The squared distance in the first common frame, of which there is one; NaN in a gap [px^2].
  float firstDistance2(int p, int q) const {
    const int frame = std::max(first_[p], first_[q]);
    return at(p, frame).distance2(at(q, frame));
  }
  /// The largest squared distance over common frames [px^2]; negative if there is none.
  float maxDistance2(int p, int q) const;

 private:
  int frames_;
  std::vector<int> first_;
  std::vector<int> last_;
  std::vector<std::size_t> begin_;  // of each tracklet, with NaN before it: lanes may reach there
  ImageBox extent_;
  std::vector<char> gaps_;
  std::vector<float> u_;
  std::vector<float> v_;
};

}  // namespace mvo
