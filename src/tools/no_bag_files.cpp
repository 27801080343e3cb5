// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "tools/bag_files.hpp"

namespace mvo_tools {

namespace {

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error(path + ": this build has no ROS, so bags are neither read nor written");
}

}  // namespace

SequenceSink bagSink(const std::string& path, const mvo::SequenceInfo& /*info*/) { refuse(path); }

mvo::Truth truthOfBag(const std::string& path) { refuse(path); }

}  // namespace mvo_tools
