// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The model's numbers under their names, as they leave the library and come back.
#pragma once

#include "frontend/camera/error_field.hpp"
#include "mvo/camera_errors.hpp"

namespace mvo {

/// Name of a term in files and messages, and its unit.
const char* termName(int term);
const char* termUnit(int term);

LearntCameraErrors learntErrors(const StereoCamera& camera, const ErrorEstimate& estimate);

/// Throws std::invalid_argument, one sentence, if it is of another camera or another model or is no
/// Gaussian.
ErrorEstimate estimateOf(const LearntCameraErrors& learnt, const StereoCamera& camera);

}  // namespace mvo
