// SPDX-License-Identifier: BSD-3-Clause
// Commands of programs and nodes.
#pragma once

#include <string>
#include <vector>

#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

/// A list with a program and its arguments. A program with a '/' in its name is a file, relative to the scenario's;
/// others are to be found by PATH.
std::vector<std::string> read_command(const YamlNode& node);

}  // namespace waitpoint::scenario
