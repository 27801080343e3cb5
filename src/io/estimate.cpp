// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "io/covariances_csv.hpp"
#include "io/labels_csv.hpp"
#include "io/sequences/numbered_files.hpp"
#include "io/timing_csv.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

Estimate readEstimate(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "camera.tum"))
    throw std::runtime_error(folder.string() + " holds no camera.tum");
  Estimate estimate;
  estimate.camera = readTum(folder / "camera.tum");
  for (const auto& [id, path] : numberedFiles(folder, "motion_", ".tum"))
    estimate.motions[id] = readTum(path);
  estimate.has_labels = std::filesystem::exists(folder / "labels.csv");
  if (estimate.has_labels) estimate.labels = readLabels(folder / "labels.csv");
  if (std::filesystem::exists(folder / "timing.csv"))
    estimate.timings = readTimings(folder / "timing.csv");
  if (std::filesystem::exists(folder / "covariances.csv"))
    estimate.covariances = readCovariances(folder / "covariances.csv");
  return estimate;
}

}  // namespace mvo
