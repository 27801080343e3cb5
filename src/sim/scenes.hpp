// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The layouts of the named scenes: each adds the room, the bodies and the camera's motion to a
// scene that has its seed, options and camera.
#pragma once

#include "mvo/sim.hpp"

namespace mvo::sim {

Scene blocksScene(Scene scene);
Scene spinScene(Scene scene);
Scene staticScene(Scene scene);
Scene occlusionScene(Scene scene);
Scene carsScene(Scene scene);
Scene streetScene(Scene scene);
Scene peopleScene(Scene scene);
Scene passingScene(Scene scene);
Scene twelveScene(Scene scene);
Scene corridorScene(Scene scene);
Scene slowScene(Scene scene);

}  // namespace mvo::sim
