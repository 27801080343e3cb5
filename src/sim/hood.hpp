// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What carries the camera, as far as the camera sees it.
#pragma once

#include "mvo/sim.hpp"

namespace mvo::sim {

/// A bonnet before the camera, in the camera's frame, whose far edge is a row of the left image:
/// below it, that share of its height is covered. Empty for a share of 0.
std::vector<Face> hoodFaces(const Scene& scene, double share);

}  // namespace mvo::sim
