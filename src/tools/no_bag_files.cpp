// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "tools/bag_files.hpp"

namespace mvo_tools {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error(what + ": this build has no ROS, so bags are neither read nor written");
}

}  // namespace

SequenceSink bagSink(const std::string& path, const mvo::SequenceInfo& /*info*/) {
  refuse("cannot write " + path);
}

mvo::Truth truthOfBag(const std::string& path) { refuse("cannot read the truth from " + path); }

}  // namespace mvo_tools
