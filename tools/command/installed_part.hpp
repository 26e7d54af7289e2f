// SPDX-License-Identifier: BSD-3-Clause
// Libraries and programs that are found by their names, beside this one.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::tools {

/// The part of this name: built with this program, or installed with it. BadInput where there is none.
std::filesystem::path find_part(const std::string& name);

}  // namespace waitpoint::tools
