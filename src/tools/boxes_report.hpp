// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known by boxes, for the report of an evaluation.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mvo/evaluation.hpp"

namespace mvo_tools {

/// The keys box_label, boxed_bodies, outside_boxes and, if any are known, velocities.
nlohmann::ordered_json boxesJson(const mvo::BoxEvaluation& boxes);

/// A line for each body, one for what is outside, one for all velocities.
std::string boxesText(const mvo::BoxEvaluation& boxes);

}  // namespace mvo_tools
