// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mvo_tools {

/// A file or folder that is written under a temporary name beside its target and renamed by
/// commit(). Without commit nothing is left behind and an older target stays as it was.
class StagedOutput {
 public:
  enum class Kind { kFile, kFolder };

  /// Creates missing parent folders, and the temporary folder if it is one. Throws
  /// std::runtime_error, one sentence, if the target exists and `force` is off, if a folder to be
  /// replaced does not hold `marker` (it is somebody else's), or if nothing can be written there.
  StagedOutput(const std::filesystem::path& target, Kind kind, bool force,
               const std::string& marker = "");
  ~StagedOutput();
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  /// Where to write until commit(); a file keeps its extension.
  const std::filesystem::path& path() const { return staged_; }
  const std::filesystem::path& target() const { return target_; }
  /// Gives the output its name, replacing an older one. Throws std::runtime_error.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staged_;
  std::vector<std::filesystem::path> created_parents_;  // innermost first
  bool committed_ = false;
};

}  // namespace mvo_tools
