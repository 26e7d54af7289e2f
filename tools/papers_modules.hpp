// SPDX-License-Identifier: BSD-3-Clause
// The modules shipped with waitpoint, under the names that scenarios use.
#pragma once

#include <vector>

#include "modules/genom/module_type.hpp"

namespace waitpoint::tools {

/// The five modules of the paper: ndd, pom, rflex, segloc, sick.
std::vector<genom::ModuleType> papers_modules();
/// The paper's modules and wander.
std::vector<genom::ModuleType> shipped_modules();

}  // namespace waitpoint::tools
