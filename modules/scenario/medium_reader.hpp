// SPDX-License-Identifier: BSD-3-Clause
// Reads the medium of a scenario: what lies between robots that send to each other.
#pragma once

#include "fibers/io/medium.hpp"
#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// What makes no sense is BadInput, naming the line.
io::Medium read_medium(const YamlNode& node);

}  // namespace waitpoint::scenario
