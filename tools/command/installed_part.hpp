// SPDX-License-Identifier: BSD-3-Clause
// Libraries and programs that are located by name, relative to this program.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::tools {

/// The part of this name from the build folder or the installation. BadInput if it is missing.
std::filesystem::path find_part(const std::string& name);

}  // namespace waitpoint::tools
