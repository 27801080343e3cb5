// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that exist completely or not at all.
#pragma once

#include <filesystem>
#include <fstream>

namespace mvo {

/// Writes to a temporary name beside the target; commit() gives it its name. Without commit nothing
/// is left behind and an older file of that name stays as it was.
class AtomicFile {
 public:
  /// Throws std::runtime_error naming the file if it cannot be created.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// Where the bytes go until commit(), for writers that open files by name themselves.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Throws std::runtime_error naming the file if not every byte could be written.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace mvo
