// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A simulated recording in memory, as the library reads it: rectified grey stereo pairs.
#pragma once

#include <future>
#include <vector>

#include "mvo/sim.hpp"

namespace mvo::test {

struct RenderedSequence {
  StereoCamera camera;
  std::vector<Frame> frames;
};

/// Four blocks that swing and turn before a moving camera: five motions. On two threads.
inline RenderedSequence renderBlocks(int width, int height, int frames) {
  sim::SceneOptions options;
  options.width = width;
  options.height = height;
  const sim::Scene scene = sim::makeScene("blocks", 1, options);
  RenderedSequence out{scene.camera, {}};
  out.frames.resize(static_cast<std::size_t>(frames));
  const auto render_every_second = [&](int first) {
    for (int k = first; k < frames; k += 2)
      out.frames[static_cast<std::size_t>(k)] = sim::toFrame(sim::render(scene, k));
  };
  const auto odd = std::async(std::launch::async, [&] { render_every_second(1); });
  render_every_second(0);
  odd.wait();
  return out;
}

}  // namespace mvo::test
