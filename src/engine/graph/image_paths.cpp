// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/graph/image_paths.hpp"

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

// Over the `n` frames that end before the pointers' places, and some before them that are not
// common: there one of the two is NaN, which no comparison is true for. Nothing is fused: ties are
// the same on machines that round twice.
MVO_INLINE float largestDistance2(const float* pu, const float* pv, const float* qu,
                                  const float* qv, int n) {
  Floats largest = Floats{} - 1;
  for (int k = -kFloats; k > -n - kFloats; k -= kFloats) {
    const Floats du =
        *reinterpret_cast<const Floats*>(pu + k) - *reinterpret_cast<const Floats*>(qu + k);
    const Floats dv =
        *reinterpret_cast<const Floats*>(pv + k) - *reinterpret_cast<const Floats*>(qv + k);
    const Floats d2 = du * du + dv * dv;
    largest = d2 > largest ? d2 : largest;
  }
  float result = largest[0];
  for (int i = 1; i < kFloats; ++i) result = std::max<float>(result, largest[i]);
  return result;
}

}  // namespace

ImagePaths::ImagePaths(const Window& window) : frames_(std::max(0, window.frames())) {
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  const std::size_t n = window.tracklets.size();
  first_.reserve(n);
  last_.reserve(n);
  begin_.reserve(n);
  std::size_t end = 0;
  for (const Tracklet& t : window.tracklets) {
    first_.push_back(static_cast<int>(t.first() - window.first_frame));
    last_.push_back(static_cast<int>(t.last() - window.first_frame));
    begin_.push_back(end + kFloats);
    end = begin_.back() + last_.back() - first_.back() + 1;
  }
  u_.assign(end, kMissing);
  v_.assign(end, kMissing);
  gaps_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    int seen = 0;
    for (const Observation& o : window.tracklets[i].observations) {
      const ImagePoint p{static_cast<float>(o.y.x()), static_cast<float>(o.y.y())};
      const std::size_t k = begin_[i] + (o.frame - window.first_frame) - first_[i];
      u_[k] = p.u;
      v_[k] = p.v;
      if (!p.isFinite()) continue;
      extent_.add(ImageBox::around(p));
      ++seen;
    }
    gaps_[i] = seen < last_[i] - first_[i] + 1 ? 1 : 0;
  }
}

float ImagePaths::maxDistance2(int p, int q) const {
  const int end = std::min(last_[p], last_[q]) + 1;
  const int n = end - std::max(first_[p], first_[q]);
  const std::size_t i = begin_[p] + end - first_[p];
  const std::size_t j = begin_[q] + end - first_[q];
  if (n <= 0) return -1;
  return onThisMachine([&](auto /*machine*/) MVO_KERNEL {
    return largestDistance2(&u_[i], &v_[i], &u_[j], &v_[j], n);
  });
}

}  // namespace mvo
