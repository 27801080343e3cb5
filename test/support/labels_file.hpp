// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// labels.csv as the bag tool writes it while it runs, for tests that need one at once.
#pragma once

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <vector>

#include "io/stamp.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo::test {

inline void writeLabels(const std::filesystem::path& path, const std::vector<LabelRow>& rows) {
  std::ofstream out(path);
  out << "stamp,tracklet_id,u,v,motion_id\n" << std::fixed << std::setprecision(3);
  for (const LabelRow& row : rows)
    out << formatStamp(row.stamp_ns) << ',' << row.tracklet << ',' << row.u << ',' << row.v << ','
        << row.motion_id << '\n';
}

}  // namespace mvo::test
