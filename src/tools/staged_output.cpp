// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/staged_output.hpp"

#include <unistd.h>

#include <stdexcept>
#include <system_error>

namespace mvo_tools {

namespace fs = std::filesystem;

namespace {

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

fs::path absoluteWithoutSlash(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

fs::path hiddenSibling(const fs::path& target, const std::string& word) {
  return target.parent_path() / ("." + target.stem().string() + "." + word +
                                 std::to_string(::getpid()) + target.extension().string());
}

}  // namespace

StagedOutput::StagedOutput(const fs::path& target, Kind kind, bool force, const std::string& marker)
    : target_(absoluteWithoutSlash(target)), staged_(hiddenSibling(target_, "part")) {
  const auto refuse = [&](const std::string& problem) {
    throw std::runtime_error("output " + quoted(target) + " " + problem);
  };
  std::error_code error;
  if (fs::exists(target_, error)) {
    if (!force) refuse("exists already (--force replaces it)");
    if (fs::is_directory(target_) != (kind == Kind::kFolder))
      refuse(kind == Kind::kFolder ? "is not a folder" : "is a folder");
    if (kind == Kind::kFolder && !fs::is_empty(target_) && !fs::exists(target_ / marker))
      refuse("is not replaced: it holds files, but no " + marker + " of an earlier run");
  }
  for (fs::path parent = target_.parent_path(); !fs::exists(parent, error);
       parent = parent.parent_path())
    created_parents_.push_back(parent);
  fs::create_directories(target_.parent_path(), error);
  if (!error && kind == Kind::kFolder) fs::create_directory(staged_, error);
  if (!error && ::access(target_.parent_path().c_str(), W_OK) != 0)
    error = std::error_code(errno, std::generic_category());
  if (error) refuse("cannot be written: " + error.message());
}

StagedOutput::~StagedOutput() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(staged_, ignored);
  for (const fs::path& parent : created_parents_) fs::remove(parent, ignored);  // only if empty
}

void StagedOutput::commit() {
  std::error_code error;
  const fs::path old = hiddenSibling(target_, "old");
  const bool replaced = fs::exists(target_, error);
  if (replaced) fs::rename(target_, old, error);
  if (!error) fs::rename(staged_, target_, error);
  if (error)
    throw std::runtime_error("output " + quoted(target_) +
                             " cannot be written: " + error.message());
  committed_ = true;
  if (replaced) fs::remove_all(old, error);
}

}  // namespace mvo_tools
