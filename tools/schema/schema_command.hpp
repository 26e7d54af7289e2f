// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint schema [scenario|robot|plan|floor]`: the JSON Schema (2020-12) of a kind of file, made of the declarations
// by which it is read. Editors complete and check by it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "modules/genom/module_type.hpp"
#include "tools/command/command.hpp"

namespace waitpoint::tools {

/// The kinds of files that have a schema: `robot` is a file of robot types.
inline constexpr std::string_view schema_kinds[] = {"scenario", "robot", "plan", "floor"};

struct SchemaOptions {
  std::string kind = "scenario";
};

/// The command with its options.
void declare(Command& command, SchemaOptions& options);

/// The schema as text; modules have the parameters of these types.
std::string schema_text(std::string_view kind, std::span<const genom::ModuleType> types);

/// Prints it; returns the exit status.
int show_schema(const SchemaOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
