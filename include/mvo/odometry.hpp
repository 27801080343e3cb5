// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The door of the library: images in, the camera's and every other rigid body's SE(3) trajectory
// out.
#pragma once

#include <memory>

#include "mvo/estimate.hpp"
#include "mvo/frame.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// Owns the only memory between frames. Bad frames (empty, of another size, stamps that go back, no
/// texture) never throw: the estimate says what is wrong. Throws std::invalid_argument from the
/// constructor for invalid options or calibration.
class MultimotionOdometry {
 public:
  MultimotionOdometry(const StereoCamera& camera, const Options& options);
  ~MultimotionOdometry();
  MultimotionOdometry(MultimotionOdometry&&) noexcept;
  MultimotionOdometry& operator=(MultimotionOdometry&&) noexcept;

  /// engine.time_budget_ms counts from when the images are prepared. In any case points are
  /// followed and labelled and every motion has a pose; the rest ends when the time is up.
  MultimotionEstimate addFrame(const Frame& frame);
  /// The same of a frame that prepareFrame() has prepared, maybe in another thread, for this camera
  /// and options. A prepared frame is added once.
  MultimotionEstimate addFrame(PreparedFrame&& frame);
  /// Takes effect with the next frame. Throws std::invalid_argument naming the option if one is
  /// invalid or, like the window's length, cannot change while frames are remembered.
  void setOptions(const Options& options);
  /// Forgets all but the options; the next frame is frame 0 of a new world.
  void reset();

 private:
  struct Memory;  // of the stages, whose headers are not public

  StereoCamera camera_;
  Options options_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace mvo
