// SPDX-License-Identifier: BSD-3-Clause
// Values of parameters that are written as text in a launch file, with the types that roslaunch gives them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace waitpoint::ros1 {

/// The types of parameters' texts; "" is "auto".
inline constexpr std::string_view parameter_types[] = {"auto",   "str",  "string",  "int",
                                                       "double", "bool", "boolean", "yaml"};

/// Reads a text as `type`, which is one of parameter_types but not "yaml". "auto": a number if it is one (a double if
/// it has a '.'), true or false in letters of any case, else a string. False if the text is none of the type.
bool read_parameter(const std::string& text, std::string_view type, nlohmann::json& value);

/// "true" or "1", "false" or "0", in letters of any case. False for another text.
bool read_bool(std::string_view text, bool& value);

}  // namespace waitpoint::ros1
