// SPDX-License-Identifier: BSD-3-Clause
// Copies of a scenario's floor side by side: more robots, at constant density.
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::bench {

/// `floors` copies in rows of ten, without contact if a floor lies within 60 m x 60 m of the origin; robots' names get
/// the number of their floor as suffix. For scenarios without a map file.
scenario::Scenario side_by_side(const scenario::Scenario& floor, int floors);

}  // namespace waitpoint::bench
