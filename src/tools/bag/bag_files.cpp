// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag_files.hpp"

#include <memory>

#include "ros/bag/truth_bag.hpp"
#include "ros/bag/truth_reader.hpp"

namespace mvo_tools {

SequenceSink bagSink(const std::string& path, const mvo::SequenceInfo& info) {
  const auto bag = std::make_shared<mvo_ros::TruthBag>(path, info);
  return {[bag](const mvo::SequenceFrame& frame) { bag->add(frame); }, [bag] { bag->close(); }};
}

mvo::Truth truthOfBag(const std::string& path) { return mvo_ros::readTruthBag(path); }

}  // namespace mvo_tools
