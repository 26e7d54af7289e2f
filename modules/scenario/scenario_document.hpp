// SPDX-License-Identifier: BSD-3-Clause
// The one document that a scenario's files and the --set options make together, before its values are read.
//
//   world: {include: floor.yaml, shapes: [...]}
//   robot_types: {include: types.yaml, ...}
//
// The included floor lies under the world: its keys count where the world does not have them, its shapes come first,
// and a shape of the world that bears the name of a floor's shape changes that one. Included robot types lie under the
// scenario's own. Options are applied in their order and see what is included: `world.shapes=[]` empties the floor,
// `world.shapes.pillar.known=false` reaches into it. Only `world`, `robot_types` and their `include` are set before.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// The format number that this program reads.
inline constexpr int scenario_format = 1;

/// Throws BadInput where a file cannot be read, has another format, or an option has no place.
YamlNode scenario_document(const std::filesystem::path& file, const std::vector<std::string>& assignments);

}  // namespace waitpoint::scenario
