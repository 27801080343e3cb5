// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/timing_csv.hpp"

#include <iomanip>

#include "io/atomic_file.hpp"
#include "io/stamp.hpp"
#include "io/text_lines.hpp"

namespace mvo {

std::vector<TimingRow> readTimings(const std::filesystem::path& path) {
  CsvReader csv(path, {"stamp", "stage", "ms"});
  std::vector<TimingRow> rows;
  while (csv.next()) rows.push_back({csv.stamp(0), csv.text(1), csv.number(2)});
  return rows;
}

void writeTimings(const std::filesystem::path& path, const std::vector<TimingRow>& rows) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "stamp,stage,ms\n" << std::fixed << std::setprecision(4);
  for (const TimingRow& row : rows)
    out << formatStamp(row.stamp_ns) << ',' << row.stage << ',' << row.ms << '\n';
  file.commit();
}

}  // namespace mvo
