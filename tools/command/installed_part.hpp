// SPDX-License-Identifier: BSD-3-Clause
// Libraries, programs and scenarios that are located by name, relative to this program or at the place of installation.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::tools {

/// The part of this name from beside this library, the build folder, or the installation. BadInput if it is missing.
std::filesystem::path find_part(const std::string& name);
/// A script for gdb: the build folder's, or an installed one.
std::filesystem::path find_gdb_script(const std::string& name);

/// The folder of the shipped scenarios: beside this program's (the build tree has a link there), or installed. BadInput
/// if there is none.
std::filesystem::path scenarios_folder();

/// The scenario's file: a name without a folder that is not here is that of a shipped scenario, with or without
/// ".yaml", if there is one. BadInput, with the nearest name, for a misspelt one.
std::filesystem::path find_scenario(const std::string& name);

}  // namespace waitpoint::tools
