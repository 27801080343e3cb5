// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What summary.json says of the stereo pair's own error.
#pragma once

#include <nlohmann/json.hpp>

#include "mvo/camera_errors.hpp"

namespace mvo_tools {

/// Figures and terms as {value, sd}, the unit in the name or beside them.
nlohmann::ordered_json cameraErrorsSummary(const mvo::CameraErrorReport& report);

}  // namespace mvo_tools
