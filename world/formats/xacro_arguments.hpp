// SPDX-License-Identifier: BSD-3-Clause
// The arguments of a xacro file that is used as a URDF: "${namespace}" and "$(arg namespace)" stand for text.
//
// Their values are given, or are those that the file itself has for them: <xacro:arg name default>, <xacro:property
// name value>. Xacro's macros, includes, conditions and expressions are not expanded: that is the task of xacro.
#pragma once

#include <map>
#include <string>

#include "world/formats/left_out.hpp"

namespace waitpoint::world {

/// Values by name.
using XacroArguments = std::map<std::string, std::string, std::less<>>;

/// The contents of `file` with the values in place of the arguments. An argument without a value, and an expression,
/// remain as they are, with a warning. BadInput for an argument in `given` that the file does not have.
std::string with_xacro_arguments(const std::string& contents, const std::string& file, const XacroArguments& given,
                                 LeftOut& left_out);

}  // namespace waitpoint::world
