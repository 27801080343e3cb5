// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bags as files that the tools read and write; a build without ROS has none.
#pragma once

#include <string>

#include "mvo/trajectory_files.hpp"
#include "tools/sequence_sink.hpp"

namespace mvo_tools {

/// A bag with the usual topics and truth topics. Throws std::runtime_error if it cannot be written,
/// or if this build has no ROS.
SequenceSink bagSink(const std::string& path, const mvo::SequenceInfo& info);

/// The truth topics of a bag. Throws std::runtime_error if it cannot be read, or if this build has
/// no ROS.
mvo::Truth truthOfBag(const std::string& path);

}  // namespace mvo_tools
