// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of the bodies of real sequences: boxes drawn by hand and mean velocities.
#pragma once

#include <filesystem>
#include <vector>

#include "io/sequences/times_txt.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {

// All of these throw std::runtime_error naming file, line, column and value of what cannot be.

/// boxes.csv, columns frame,x,y,width,height: one body without a name that nothing hides.
std::vector<TrueBox> readBoxes(const std::filesystem::path& path,
                               const std::vector<FrameTime>& times);

/// body_boxes.csv, columns frame,body,x1,y1,x2,y2,occluded_by: at most one box of a body per frame.
std::vector<TrueBox> readBodyBoxes(const std::filesystem::path& path,
                                   const std::vector<FrameTime>& times);

/// velocities.csv, columns first,last,body,vx,vz,sd, of bodies that have boxes.
std::vector<TrueVelocity> readVelocities(const std::filesystem::path& path,
                                         const std::vector<FrameTime>& times,
                                         const std::vector<TrueBox>& boxes);

}  // namespace mvo
