// SPDX-License-Identifier: BSD-3-Clause
// The environment of a benchmark: machine, system, compiler, packages.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::bench {

/// Several lines; `packages` are Debian's, whose installed versions are listed.
std::string surroundings(const std::vector<std::string>& packages);

}  // namespace waitpoint::bench
