// SPDX-License-Identifier: BSD-3-Clause
// The keys of robots, of their types, and of what these consist of.
//
// The modules and the executive have parameters that their own code reads: the definitions `module` and `executive` of
// a schema are given by who knows the modules (tools/schema).
#pragma once

#include "modules/scenario/keys.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

/// An element of `robots`, alone or laid over its type.
const KeyTable& robot_keys();
/// A value of `robot_types`.
const KeyTable& robot_type_keys();
/// An element of `robots_from_map`.
const KeyTable& robot_of_map_keys();

const KeyTable& goal_keys();
const KeyTable& bridge_row_keys();
const KeyTable& program_keys();

/// Of an element of `robots`; beside a log of one whose modules it drives.
Json robot_schema(SchemaDefinitions& definitions);
Json robot_of_log_schema(SchemaDefinitions& definitions);
Json robots_from_map_schema(SchemaDefinitions& definitions);
Json control_schema(SchemaDefinitions& definitions);

}  // namespace waitpoint::scenario
