// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequences/numbered_files.hpp"

namespace mvo {

namespace {

constexpr std::size_t kMaxDigits = 9;  // fits into an int

}  // namespace

std::map<int, std::filesystem::path> numberedFiles(const std::filesystem::path& folder,
                                                   const std::string& prefix,
                                                   const std::string& suffix) {
  std::map<int, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= prefix.size() + suffix.size() || name.rfind(prefix, 0) != 0 ||
        name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
      continue;
    const std::string digits =
        name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    if (digits.size() <= kMaxDigits && digits.find_first_not_of("0123456789") == std::string::npos)
      files[std::stoi(digits)] = entry.path();
  }
  return files;
}

}  // namespace mvo
