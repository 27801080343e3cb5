// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What an eye sees of a scene, row by row as it is read out.
#pragma once

#include <functional>
#include <vector>

#include "sim/bent_rays.hpp"
#include "sim/eye.hpp"
#include "sim/raster.hpp"

namespace mvo::sim {

/// All faces that an eye may see at a time [s]. The scene's faces must outlive the result.
std::vector<ProjectedFace> projectScene(const Scene& scene, double time, const Eye& eye,
                                        const Grid& grid);

/// Some rows of a view: what may be seen at their time, what is seen, and the rays if they are
/// bent.
struct ViewedRows {
  const std::vector<ProjectedFace>& faces;
  const Visibility& seen;
  const BentRays* rays = nullptr;
};

/// Looks at a scene with n x n samples per pixel, rows that belong together at a time: all of them
/// if they are exposed at once and rays are straight. `time` is that of the frame's stamp [s].
void lookAt(const Scene& scene, double time, const Eye& eye, int n,
            const std::function<void(const ViewedRows&)>& visit);

/// The image before the sensor; 32F, grey or for RGB-D blue, green and red.
cv::Mat light(const Scene& scene, double time, const Eye& eye);

}  // namespace mvo::sim
