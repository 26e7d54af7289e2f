// SPDX-License-Identifier: BSD-3-Clause
// The modules that come with waitpoint, by the names that scenarios use.
#pragma once

#include <vector>

#include "modules/genom/module_type.hpp"

namespace waitpoint::tools {

/// The paper's five: ndd, pom, rflex, segloc, sick.
std::vector<genom::ModuleType> papers_modules();
/// Those, and wander.
std::vector<genom::ModuleType> shipped_modules();

}  // namespace waitpoint::tools
