// SPDX-License-Identifier: BSD-3-Clause
// Combines a scenario's files and the --set options into one document, before its values are read.
//
//   world: {include: floor.yaml, shapes: [...]}
//   robot_types: {include: types.yaml, ...}
//
// The included floor is the base of the world: the world's keys override it; the floor's shapes come first, and a shape
// of the world with the name of one of the floor's overrides that one. Included robot types are the base of the
// scenario's own. Options are applied in order, after the includes: `world.shapes=[]` empties the floor,
// `world.shapes.pillar.known=false` changes one of its shapes. Only options that set `world`, `robot_types` or an
// `include` are applied before the includes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// Throws BadInput for an unreadable file, another format version, or an option whose path does not exist.
YamlNode scenario_document(const std::filesystem::path& file, const std::vector<std::string>& assignments);

}  // namespace waitpoint::scenario
