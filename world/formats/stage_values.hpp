// SPDX-License-Identifier: BSD-3-Clause
// Values of properties in a Stage world, read strictly: anything unexpected is BadInput at its line.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "world/formats/stage_syntax.hpp"

namespace waitpoint::world {

/// The frame of a thing: a planar pose and a height.
struct StageFrame {
  Pose pose;
  double z_m = 0;
};

struct StageSize {
  double x_m = 0.1, y_m = 0.1, z_m = 0.1;
};

[[noreturn]] void refuse(const StagePlace& place, const std::string& message);

/// One number from `low` to `high`.
double stage_number(const StageProperty& property, double low, double high);
/// A list of `size_min` to `size_max` numbers, none beyond coordinate_m_max.
std::vector<double> stage_numbers(const StageProperty& property, std::size_t size_min, std::size_t size_max);
/// The strength of a return to a sensor: one number of any size.
double stage_return(const StageProperty& property);
/// The one word or text.
std::string stage_text(const StageProperty& property);
double stage_number_or(const StageThing& thing, StageKey key, double low, double high, double otherwise);

/// The thing's place, given by its `pose` in `outer`.
StageFrame stage_frame(const StageThing& thing, const StageFrame& outer);
/// The centre of the thing in its own frame: `origin`.
Pose stage_origin(const StageThing& thing);
/// `size`, positive, but its height may be 0; 0.1 m each by default.
StageSize stage_size(const StageThing& thing);

}  // namespace waitpoint::world
