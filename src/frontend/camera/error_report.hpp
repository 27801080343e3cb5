// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pair's error in pixels, degrees, percent and milliseconds.
#pragma once

#include "frontend/camera/error_field.hpp"
#include "mvo/camera_errors.hpp"

namespace mvo {

/// Figures, deviations and the sentence.
CameraErrorReport errorReport(const StereoCamera& camera, const ErrorEstimate& estimate);

}  // namespace mvo
