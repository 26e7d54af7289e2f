// SPDX-License-Identifier: BSD-3-Clause
// Values of ROS's parameters in YAML, as rosparam reads them: by the rules of YAML 1.1 for plain words.
//
//   true, yes, on, false, no, off       truth values, in small, capital or Capitalised letters
//   12, +1_000, 0x1F, 0b101, 017        integers; the last one is octal
//   1.5, .5, 1., 1.0e+3, .inf, .nan     doubles: those with a '.', and a sign in an exponent; so 1e3 is a text
//   deg(90), rad(pi/2)                  doubles in radians, of an expression with pi
//
// All others, and all in quotes, are texts: so is 1:30, which YAML 1.1 reads to the base 60.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// Null for a null node. BadInput for an integer of more than 64 bits, and a wrong expression.
nlohmann::json parameter_value(const YamlNode& node);

}  // namespace waitpoint::scenario
