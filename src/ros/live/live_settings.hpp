// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The part of the parameters that may change while the node runs, as dynamic_reconfigure has it.
#pragma once

#include <mvo/MvoConfig.h>

#include "ros/parameters/parameters.hpp"

namespace mvo_ros {

/// The settings of the parameters.
mvo::MvoConfig liveSettings(const Parameters& parameters);

/// The parameters with these settings. Throws std::invalid_argument for settings that the
/// parameters' ranges refuse.
Parameters withLiveSettings(Parameters parameters, const mvo::MvoConfig& settings);

}  // namespace mvo_ros
