// SPDX-License-Identifier: BSD-3-Clause
// The parts of a scenario's schema that modules and executives declare by reading their settings: a description is made
// of each by constructing it with settings that only collect what is read.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "modules/scenario/value_schema.hpp"

namespace waitpoint::tools {

/// The definitions `module`, `executive`, `control`, of module and control the complete ones, and those that they refer
/// to.
scenario::Json module_definitions(std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
