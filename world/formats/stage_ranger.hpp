// SPDX-License-Identifier: BSD-3-Clause
// The lasers of one of Stage's range finders, of the present type and of those of earlier versions of Stage:
//
//   ranger   with `sensor`s: pose, range [least most], fov, samples             (Stage 4)
//   ranger   scount, spose[i] [x y heading], sview [least most fov], sview[i]   (Stage 2 and 3; also named `sonar`)
//   laser    samples, range_max, fov                                            (Stage 2 and 3)
#pragma once

#include <cstddef>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"
#include "world/formats/stage_values.hpp"

namespace waitpoint::world {

/// The limit of things in a file; the things of a type count at each use.
inline constexpr std::size_t stage_thing_count_max = std::size_t{1} << 20;

/// Increments `thing_count`; BadInput beyond the limit.
void count_stage_thing(const StageThing& thing, std::size_t& thing_count);

/// The lasers of a `ranger` or `laser` in `frame`, in the order of the file, the type's own first. Sensors of one beam
/// each, evenly spaced at one place, are one laser.
std::vector<LaserDescription> read_stage_ranger(const StageThing& ranger, const StageFrame& frame, LeftOut& left_out,
                                                std::size_t& thing_count);

}  // namespace waitpoint::world
