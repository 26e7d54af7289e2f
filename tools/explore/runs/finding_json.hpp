// SPDX-License-Identifier: BSD-3-Clause
// A run's result in JSON.
#pragma once

#include <string>

#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

/// An object: the kind of failure ("passed" for none), what failed in words, the virtual time, the digest if known.
std::string finding_json(const Finding& finding);

}  // namespace waitpoint::tools
