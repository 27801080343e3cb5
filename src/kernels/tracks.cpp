// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr int kEntries = 12;

// A tracklet's arrays and a step's transforms from the first frame b on.
struct Pairs {
  const float* x;
  const float* y;
  const float* d;
  const int* rank;
  const float* T_b_a;
  int stride;
  int between;   // frames from a to b
  int thinning;  // a power of two
  int count;     // frames b
};

struct Squares {
  Floats largest = Floats{} - 1.0F;
  Ints missing = {};
};

template <typename M, ResidualModel kModel>
MVO_INLINE void addPairs(const LinkConstants<EightLinks>& k, const Pairs& pairs, Squares& squares) {
  for (int i = 0; i < pairs.count; i += kFloats) {
    Floats T[kEntries];
    for (int entry = 0; entry < kEntries; ++entry)
      T[entry] = load(pairs.T_b_a + entry * pairs.stride + i);
    const Floats from[3] = {load(pairs.x + i - pairs.between), load(pairs.y + i - pairs.between),
                            load(pairs.d + i - pairs.between)};
    const Floats seen[3] = {load(pairs.x + i), load(pairs.y + i), load(pairs.d + i)};
    Floats e2;
    squaredResidual<M, EightLinks, kModel>(k, T, from, seen, e2);
    const Ints rank = *reinterpret_cast<const Ints*>(pairs.rank + i);
    const Ints taken =
        (from[0] == from[0]) & (seen[0] == seen[0]) & ((rank & (pairs.thinning - 1)) == 0);
    squares.missing |= taken & (T[0] != T[0]);
    squares.largest = (taken & (e2 > squares.largest)) != 0 ? e2 : squares.largest;
  }
}

template <typename M>
MVO_INLINE void addPairsOf(ResidualModel model, const LinkConstants<EightLinks>& k,
                           const Pairs& pairs, Squares& squares) {
  if (model == ResidualModel::kWhitened)
    addPairs<M, ResidualModel::kWhitened>(k, pairs, squares);
  else
    addPairs<M, ResidualModel::kImageDistance>(k, pairs, squares);
}

}  // namespace

TrackArrays::TrackArrays(const Window& window, const StereoCamera& camera) {
  std::size_t end = 0;
  for (const Tracklet& t : window.tracklets) {
    const int first = static_cast<int>(t.first() - window.first_frame);
    const int last = static_cast<int>(t.last() - window.first_frame);
    spans_.push_back(
        {first, last, end, static_cast<int>(t.observations.size()) == last - first + 1});
    end += last - first + kFloats;
  }
  x_.assign(end, kNone);
  y_.assign(end, kNone);
  d_.assign(end, kNone);
  rank_.assign(end, 0);
  for (std::size_t p = 0; p < spans_.size(); ++p) {
    int rank = static_cast<int>(window.tracklets[p].observations.size());
    for (const Observation& o : window.tracklets[p].observations) {
      const std::size_t i = spans_[p].begin + (o.frame - window.first_frame) - spans_[p].first;
      const LinkPoint<EightLinks> point(camera, o.y);
      x_[i] = point.x;
      y_[i] = point.y;
      d_[i] = point.d;
      rank_[i] = --rank;
    }
  }
}

LabelResiduals::LabelResiduals(const Window& window, const TrackArrays& tracks,
                               const Trajectory& trajectory, const LinkResidual& residual,
                               bool long_pairs)
    : window_(window),
      tracks_(tracks),
      trajectory_(trajectory),
      residual_(residual),
      constants_(residual.camera(), residual.disparityVariance()),
      model_(residual.model()),
      stride_(window.frames() + kFloats) {
  for (const int frames : {1, 2, 4, 8, 16}) {
    if (frames > 1 && !long_pairs) break;
    // Longer pairs thin out with their length, counted from the newest observation so that it is
    // always tested.
    Step step{frames, std::max(1, frames / 2),
              std::vector<float>(static_cast<std::size_t>(kEntries) * stride_, kNone)};
    for (int k = frames; k < window.frames(); ++k) {
      const FrameId b = window.first_frame + k;
      const auto T = trajectory.between(b, b - frames);
      if (!T) continue;
      for (int entry = 0; entry < kEntries; ++entry)
        step.T_b_a[entry * stride_ + k] = static_cast<float>((*T)(entry / 4, entry % 4));
    }
    steps_.push_back(std::move(step));
  }
}

Worst LabelResiduals::worst(int tracklet) const {
  const TrackArrays::Span& span = tracks_.spans_[tracklet];
  Squares squares;
  for (const Step& step : steps_) {
    const std::size_t i = span.begin + step.frames;
    const Pairs pairs{tracks_.x_.data() + i,
                      tracks_.y_.data() + i,
                      tracks_.d_.data() + i,
                      tracks_.rank_.data() + i,
                      step.T_b_a.data() + span.first + step.frames,
                      stride_,
                      step.frames,
                      step.thinning,
                      span.last - span.first + 1 - step.frames};
    onThisMachine([&](auto machine) MVO_KERNEL {
      addPairsOf<decltype(machine)>(model_, constants_, pairs, squares);
    });
  }
  Worst worst;
  float largest = -1;
  for (int lane = 0; lane < kFloats; ++lane) {
    largest = std::max<float>(largest, squares.largest[lane]);
    worst.missing = worst.missing || squares.missing[lane] != 0;
  }
  if (largest >= 0) worst.shared = std::sqrt(static_cast<double>(largest));
  if (!span.whole) addGaps(window_.tracklets[tracklet], worst);
  return worst;
}

void LabelResiduals::addGaps(const Tracklet& tracklet, Worst& worst) const {
  const auto& o = tracklet.observations;
  for (std::size_t j = 1; j < o.size(); ++j) {
    if (o[j].frame - o[j - 1].frame == 1) continue;
    if (const auto T = trajectory_.between(o[j].frame, o[j - 1].frame))
      worst.shared = std::max(worst.shared, residual_(*T, o[j - 1].y, o[j].y));
    else
      worst.missing = true;
  }
}

}  // namespace mvo
