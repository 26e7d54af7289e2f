// SPDX-License-Identifier: BSD-3-Clause
// A tree of YAML values as text again, in flow style: each entry of the uppermost map on a line of its own.
#pragma once

#include <string>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::fuzz {

std::string text_of(const scenario::YamlNode& root);

}  // namespace waitpoint::fuzz
