// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The door of the library: images in, the camera's and every other rigid body's SE(3) trajectory
// out.
#pragma once

#include <memory>
#include <optional>

#include "mvo/camera_errors.hpp"
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
  /// Forgets all but the options and what setCameraErrors() gave; the next frame is frame 0 of a
  /// new world.
  void reset();

  /// The stereo pair's own error as known after the last frame; none of RGB-D and if camera.errors
  /// is off.
  std::optional<CameraErrorReport> cameraErrors() const;
  /// Starts from what an earlier run with this camera learnt. Before the first frame, or followed
  /// by reset(). Throws std::invalid_argument, one sentence, if it is another camera's.
  void setCameraErrors(const LearntCameraErrors& learnt);

 private:
  struct Memory;  // of the stages, whose headers are not public

  StereoCamera camera_;
  Options options_;
  std::optional<LearntCameraErrors> known_errors_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace mvo
