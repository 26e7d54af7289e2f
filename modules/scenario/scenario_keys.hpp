// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scenario's own maps, and of the files that it includes.
#pragma once

#include "modules/scenario/keys.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

/// The supported version of the format.
inline constexpr int scenario_format = 1;

const KeyTable& scenario_keys();
const Keys<Scenario>& world_keys();
/// Of `world.map` that is a map.
const Keys<MapFile>& map_keys();

/// A file of `world.include`.
const KeyTable& floor_keys();
/// A file of `robot_types.include`.
const KeyTable& robot_types_keys();

}  // namespace waitpoint::scenario
