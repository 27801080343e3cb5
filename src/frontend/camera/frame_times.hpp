// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "mvo/types.hpp"

namespace mvo {

/// Stamps of frames [s].
using FrameTimes = std::map<FrameId, double>;

}  // namespace mvo
