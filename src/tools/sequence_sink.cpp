// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sequence_sink.hpp"

#include <memory>

#include "mvo/sequence.hpp"

namespace mvo_tools {

SequenceSink folderSink(const std::filesystem::path& folder, const mvo::SequenceInfo& info) {
  const auto writer = std::make_shared<mvo::SequenceWriter>(folder, info);
  return {[writer](const mvo::SequenceFrame& frame) { writer->add(frame); },
          [writer] { writer->finish(); }};
}

}  // namespace mvo_tools
