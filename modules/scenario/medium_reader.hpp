// SPDX-License-Identifier: BSD-3-Clause
// Reads the medium of a scenario: the model of communication between robots.
#pragma once

#include "fibers/io/medium.hpp"
#include "modules/scenario/keys.hpp"

namespace waitpoint::scenario {

const Keys<io::Medium>& medium_keys();
/// Throws BadInput with the line for values out of range.
io::Medium read_medium(const YamlNode& node);

}  // namespace waitpoint::scenario
