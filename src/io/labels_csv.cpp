// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/labels_csv.hpp"

#include "io/text_lines.hpp"

namespace mvo {

std::vector<LabelRow> readLabels(const std::filesystem::path& path) {
  CsvReader csv(path, {"stamp", "tracklet_id", "u", "v", "motion_id"});
  std::vector<LabelRow> rows;
  while (csv.next()) {
    const std::int64_t id = csv.integer(4);
    if (id < -1 || id > INT32_MAX)
      csv.fail("motion_id " + csv.text(4) + " is neither -1 nor an id");
    rows.push_back(
        {csv.stamp(0), csv.integer(1), csv.number(2), csv.number(3), static_cast<int>(id)});
  }
  return rows;
}

}  // namespace mvo
