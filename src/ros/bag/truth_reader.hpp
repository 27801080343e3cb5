// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The truth topics of a bag (see truth_bag.hpp) as the evaluator's truth.
#pragma once

#include <string>

#include "mvo/trajectory_files.hpp"

namespace mvo_ros {

/// Reads /truth/camera, /truth/object_<id>, /truth/mask and /truth/objects, each optional. Frames
/// are those of the left (colour) images, or without images those of the truth. Throws
/// std::runtime_error, one sentence, for a bag that cannot be read or has no truth topic.
mvo::Truth readTruthBag(const std::string& path);

}  // namespace mvo_ros
