// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// calib.json: the camera of a sequence folder.
#pragma once

#include <filesystem>

#include "mvo/sequence.hpp"

namespace mvo {

/// All but the rate, which the stamps tell. Throws std::runtime_error naming the file that cannot
/// be read or be a calibration.
SequenceInfo readCalibration(const std::filesystem::path& path);

}  // namespace mvo
