// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/graph/frame_grids.hpp"

#include <cmath>
#include <cstddef>

namespace mvo {

namespace {

constexpr float kPerCell = 2;     // sightings, on average
constexpr float kMaxCells = 256;  // along one side of the grid

}  // namespace

FrameGrids::FrameGrids(const std::vector<Sighting>& sightings, const ImageBox& extent, int frames) {
  const float width = std::max(0.0F, extent.right - extent.left);
  const float height = std::max(0.0F, extent.bottom - extent.top);
  const float count =
      static_cast<float>(sightings.size()) / (kPerCell * static_cast<float>(std::max(1, frames)));
  const float side = std::max({std::sqrt(width * height / std::max(count, 1.0F)),
                               std::max(width, height) / kMaxCells, 1.0F});
  origin_ = {extent.left, extent.top};
  per_side_ = 1 / side;
  columns_ = static_cast<int>(width / side) + 1;
  rows_ = static_cast<int>(height / side) + 1;
  last_column_ = static_cast<float>(columns_ - 1);
  last_row_ = static_cast<float>(rows_ - 1);

  std::vector<int> cell_of;
  cell_of.reserve(sightings.size());
  begin_.assign(static_cast<std::size_t>(cell(frames, 0, 0)) + 1, 0);
  for (const Sighting& s : sightings) {
    cell_of.push_back(s.at.isFinite() ? cell(s.frame, row(s.at.v, 0), column(s.at.u, 0))
                                      : cell(s.frame, rows_, 0));
    ++begin_[cell_of.back()];
  }
  // Counts become ends, and ends beginnings as the cells fill from behind.
  int sum = 0;
  for (int& b : begin_) b = sum += b;
  at_.resize(sightings.size());
  tracklet_.resize(sightings.size());
  for (std::size_t i = sightings.size(); i-- > 0;) {
    const int place = --begin_[cell_of[i]];
    at_[place] = sightings[i].at;
    tracklet_[place] = sightings[i].tracklet;
  }
}

}  // namespace mvo
