// SPDX-License-Identifier: BSD-3-Clause
// Grounds of any size that are everywhere alike.
#pragma once

#include "tests/bench/world/places.hpp"

namespace waitpoint::bench {

/// So many obstacles on as many squares of that side, boxes and discs, each somewhere about the middle of its square;
/// as many stations as wanted, spread over the corners of the squares, which are free to 0.3 m: evenly, or drawn from
/// those that are at least `border_m` inside.
Place grounds(std::size_t obstacles, double square_m, std::size_t stations, double border_m = 0);

}  // namespace waitpoint::bench
