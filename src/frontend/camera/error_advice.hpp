// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pair's error in words.
#pragma once

#include <string>

#include "mvo/camera_errors.hpp"

namespace mvo {

/// One sentence: how the right camera differs, by how many pixels, and what to do about it. Empty
/// if nothing is both far beyond its deviation and large enough to matter.
std::string errorAdvice(const CameraErrorReport& report);

}  // namespace mvo
