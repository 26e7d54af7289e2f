// SPDX-License-Identifier: BSD-3-Clause
// Uniform grounds of any size.
#pragma once

#include "tests/bench/world/places.hpp"

namespace waitpoint::bench {

/// `obstacles` boxes and discs on as many squares of side `square_m`, each near the middle of its square; `stations`
/// stations on the corners of the squares, which are free within 0.3 m: spread evenly, or drawn from those at least
/// `border_m` inside.
Place grounds(std::size_t obstacles, double square_m, std::size_t stations, double border_m = 0);

}  // namespace waitpoint::bench
