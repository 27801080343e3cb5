// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulator/frame_source.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace mvo_ros {

int toAndFro(int k, int n) {
  if (n < 2) return 0;
  const int turn = 2 * (n - 1);
  const int phase = k % turn;
  return phase < n ? phase : turn - phase;
}

FrameSource::FrameSource(mvo::sim::Scene scene, int prerender,
                         const std::function<bool(int)>& go_on)
    : scene_(std::move(scene)) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int first = 0; first < prerender && go_on(first); first += cores) {
    std::vector<std::future<mvo::SequenceFrame>> batch;
    for (int k = first; k < std::min(first + cores, prerender); ++k) batch.push_back(render(k));
    for (auto& frame : batch) rendered_.push_back(frame.get());
  }
  if (rendered_.empty()) ahead_ = render(0);
}

mvo::SequenceFrame FrameSource::next() {
  if (!rendered_.empty()) {
    const auto n = static_cast<int>(rendered_.size());
    const int k = toAndFro(step_, n);
    step_ = (step_ + 1) % std::max(1, 2 * (n - 1));
    return rendered_[static_cast<std::size_t>(k)];
  }
  mvo::SequenceFrame frame = ahead_.get();
  ahead_ = render(++step_);
  return frame;
}

std::future<mvo::SequenceFrame> FrameSource::render(int frame) const {
  return std::async(std::launch::async, [this, frame] {
    mvo::SequenceFrame out = mvo::sim::toSequenceFrame(mvo::sim::render(scene_, frame));
    out.mask.release();  // hundreds of frames may be kept
    return out;
  });
}

}  // namespace mvo_ros
