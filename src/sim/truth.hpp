// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is true of a frame's left image: whose every pixel is, how far away, how much of a body.
#pragma once

#include "mvo/sim.hpp"

namespace mvo::sim {

/// Fills mask, depth and objects at the centres of the left image's pixels, each at the time of its
/// row. A body's whole silhouette is that at the frame's stamp.
void addTruth(const Scene& scene, double time, RenderedFrame& out);

}  // namespace mvo::sim
