// SPDX-License-Identifier: BSD-3-Clause
// Where a benchmark was run: machine, system, compiler, packages.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::bench {

/// Some lines; `packages` are Debian's, of which the installed versions are told.
std::string surroundings(const std::vector<std::string>& packages);

}  // namespace waitpoint::bench
