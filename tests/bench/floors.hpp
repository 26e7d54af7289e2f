// SPDX-License-Identifier: BSD-3-Clause
// A scenario as often as asked, each time on a floor of its own beside the others: more robots, at one density.
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::bench {

/// `floors` copies in rows of ten, nothing reaching from one to another if a floor lies within 60 m x 60 m of the
/// origin; robots' names end in the number of their floor. For scenarios without a map file.
bridge::Scenario side_by_side(const bridge::Scenario& floor, int floors);

}  // namespace waitpoint::bench
