// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Families of files told apart by a number in their names.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace mvo {

/// The files <prefix><digits><suffix> of a folder, by their number.
std::map<int, std::filesystem::path> numberedFiles(const std::filesystem::path& folder,
                                                   const std::string& prefix,
                                                   const std::string& suffix);

}  // namespace mvo
