// SPDX-License-Identifier: BSD-3-Clause
// The paper's five modules, by the names that scenarios use: ndd, pom, rflex, segloc, sick.
#pragma once

#include <vector>

#include "modules/genom/module_type.hpp"

namespace waitpoint::tools {

std::vector<genom::ModuleType> papers_modules();

}  // namespace waitpoint::tools
