// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Who is where in each frame: one grid of square image cells per frame, all grids alike.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/graph/image_paths.hpp"

namespace mvo {

/// A position of a tracklet.
struct Sighting {
  ImagePoint at;
  int frame = 0;
  int tracklet = 0;
};

/// Cells of a grid, both ends included.
struct CellRange {
  int left = 0;
  int right = -1;
  int top = 0;
  int bottom = -1;

  bool operator==(const CellRange& o) const {
    return left == o.left && right == o.right && top == o.top && bottom == o.bottom;
  }
};

/// Sightings by frame and cell, a few to a cell. Those without a finite position are in none.
class FrameGrids {
 public:
  FrameGrids(const std::vector<Sighting>& sightings, const ImageBox& extent, int frames);

  /// The cells that a box reaches, or slightly more.
  CellRange cells(const ImageBox& box) const {
    constexpr float kSlack = 1e-3F;  // of a cell: rounding may move a border
    return {column(box.left, -kSlack), column(box.right, kSlack), row(box.top, -kSlack),
            row(box.bottom, kSlack)};
  }
  CellRange all() const { return {0, columns_ - 1, 0, rows_ - 1}; }
  /// The cells around one that are not more than so many rings away.
  CellRange around(const CellRange& cell, int rings) const {
    return {std::max(0, cell.left - rings), std::min(columns_ - 1, cell.right + rings),
            std::max(0, cell.top - rings), std::min(rows_ - 1, cell.bottom + rings)};
  }

  /// visit(position, tracklet) for all in a frame's cells that are not among those `seen`.
  template <typename Visit>
  void visit(int frame, const CellRange& cells, const CellRange& seen, const Visit& visit) const {
    for (int r = cells.top; r <= cells.bottom; ++r)
      if (r < seen.top || r > seen.bottom) {
        visitRun(cell(frame, r, cells.left), cell(frame, r, cells.right), visit);
      } else {
        visitRun(cell(frame, r, cells.left), cell(frame, r, std::min(cells.right, seen.left - 1)),
                 visit);
        visitRun(cell(frame, r, std::max(cells.left, seen.right + 1)), cell(frame, r, cells.right),
                 visit);
      }
  }
  /// The same for those that are in no cell.
  template <typename Visit>
  void visitUnplaced(int frame, const Visit& visit) const {
    visitRun(cell(frame, rows_, 0), cell(frame, rows_, 0), visit);
  }

 private:
  int column(float u, float more) const {
    return static_cast<int>(std::clamp((u - origin_.u) * per_side_ + more, 0.0F, last_column_));
  }
  int row(float v, float more) const {
    return static_cast<int>(std::clamp((v - origin_.v) * per_side_ + more, 0.0F, last_row_));
  }
  int cell(int frame, int row, int column) const {
    return frame * (rows_ * columns_ + 1) + row * columns_ + column;
  }

  template <typename Visit>
  void visitRun(int first, int last, const Visit& visit) const {
    if (first > last) return;
    for (int i = begin_[first]; i < begin_[last + 1]; ++i) visit(at_[i], tracklet_[i]);
  }

  ImagePoint origin_;
  float per_side_ = 1;  // of a cell [1/px]
  int columns_ = 1;
  int rows_ = 1;
  float last_column_ = 0;
  float last_row_ = 0;
  std::vector<int> begin_;  // of each cell in the arrays below, and the end
  std::vector<ImagePoint> at_;
  std::vector<int> tracklet_;
};

}  // namespace mvo
