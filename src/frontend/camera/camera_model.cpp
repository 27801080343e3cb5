// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/camera/camera_model.hpp"

namespace mvo {

bool CameraModel::isTrusted(const Options& options) const {
  return sensed_depth_ || options.camera.errors == CameraErrorMode::kOff;
}

void CameraModel::addFrame(FrameId frame, double time, bool sensed_depth, const Options& options) {
  const int frames = options.window.frames + options.window.max_gap;
  sensed_depth_ = sensed_depth;
  errors_.addFrame(frame, time, frames);
  shutter_.addFrame(frame, time, sensed_depth, frames);
}

std::optional<ErrorEstimate> CameraModel::errors(const Options& options) const {
  if (isTrusted(options)) return std::nullopt;
  return errors_.estimate();
}

void CameraModel::correct(const Window& seen, const StereoCamera& camera, const Options& options) {
  seen_ = &seen;
  paired_.reset();
  if (!isTrusted(options)) paired_ = errors_.corrected(seen);
  measured_ = shutter_.withGlobalShutter(paired(), camera, options.frontend);
}

void CameraModel::learnRows(const std::vector<Feature>& features, const TrackletWindow& window,
                            const Options& options) {
  if (!isTrusted(options)) errors_.learnRows(features, window);
}

void CameraModel::addUncertainty(Segmentation& segmentation, const StereoCamera& camera,
                                 const Options& options) {
  if (isTrusted(options)) return;
  influence_.addTo(segmentation, measured(), errors_,
                   LinkResidual(camera, options.noise, ResidualModel::kWhitened));
}

void CameraModel::learnMotion(const Trajectory& world, const std::vector<int>& support,
                              const StereoCamera& camera, const Options& options) {
  const LinkResidual residual(camera, options.noise, ResidualModel::kWhitened);
  shutter_.learn(paired(), world, support, residual, options.energy.threshold, options.frontend);
  if (!isTrusted(options)) errors_.learnMotion(measured(), world, support, residual);
}

}  // namespace mvo
