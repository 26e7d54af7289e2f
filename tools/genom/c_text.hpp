// SPDX-License-Identifier: BSD-3-Clause
// Declarations in C, and of the values with fields that stand for C's in the frame (modules/genom/c_values.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "modules/description/description.hpp"

namespace waitpoint::tools {

/// "double table[2][3]"
std::string c_declaration(const description::Type& type, const std::string& name);
/// "double *x", and for an array a pointer to its first element: "char *name", "double (*table)[3]".
std::string c_pointer(const description::Type& type, const std::string& name);
/// A text of C++ or C in quotes, with escapes.
std::string quoted_text(std::string_view text);
std::string upper(std::string text);
/// With a capital first letter.
std::string capitalised(std::string text);

/// The type in the frame: "double", "std::array<std::int32_t, 3>", "genom_fields::POINT". `inside` names a struct
/// without a name: that of the struct it is in, and of the member.
std::string frame_type(const description::Type& type, const std::string& inside);
/// The name of a struct in namespace genom_fields.
std::string fields_name(const description::Type& type, const std::string& inside);

/// Parameters of a request's codels and client functions: "DEMO_SPEED *speed, " or "".
std::string input_parameter(const description::Request& request);
std::string output_parameter(const description::Request& request);
/// Their names alone: "speed, " or "".
std::string input_name(const description::Request& request);
std::string output_name(const description::Request& request);

/// True if the request interrupts its own activities: at most one of them runs, and GenoM's codels then get the
/// internal data's members as input and output.
bool interrupts_itself(const description::Request& request);

/// The codels of a description, each once, with their prototypes.
struct Codel {
  std::string name;
  std::string prototype;   ///< without ';'
  std::string parameters;  ///< names but `report`: "(void)x;" each
  std::string returned;    ///< of the stub
  std::string comment;
};
/// Those that the control task calls, and those of each task by its number.
std::vector<Codel> control_codels(const description::Description& description);
std::vector<Codel> task_codels(const description::Description& description, std::size_t task);

}  // namespace waitpoint::tools
