// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>

namespace mvo {

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(path_.string() + ".part"), stream_(temporary_) {
  if (!stream_) throw std::runtime_error("cannot write " + path_.string());
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  stream_.close();
  if (!stream_) throw std::runtime_error("cannot write " + path_.string() + ": disk full?");
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw std::runtime_error("cannot write " + path_.string() + ": " + error.message());
  committed_ = true;
}

}  // namespace mvo
