// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The figures of an evaluation for people (a table) and for programs (JSON).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mvo/evaluation.hpp"

namespace mvo_tools {

/// All figures, metres and degrees, with the curves that the plots show. What the truth could not
/// tell has no key.
nlohmann::ordered_json toJson(const mvo::Evaluation& evaluation);

/// The figures as lines of text; notes last.
std::string toTable(const mvo::Evaluation& evaluation);

}  // namespace mvo_tools
