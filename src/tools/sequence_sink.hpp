// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the frames of a sequence go: a bag or a folder.
#pragma once

#include <filesystem>
#include <functional>

#include "mvo/sequence.hpp"

namespace mvo_tools {

/// Takes frame after frame; what was written counts once it is finished.
struct SequenceSink {
  std::function<void(const mvo::SequenceFrame&)> add;
  std::function<void()> finish;
};

/// A sequence folder. Throws std::runtime_error naming what cannot be written.
SequenceSink folderSink(const std::filesystem::path& folder, const mvo::SequenceInfo& info);

}  // namespace mvo_tools
