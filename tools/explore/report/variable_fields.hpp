// SPDX-License-Identifier: BSD-3-Clause
// The fields of a program's variables in a report: `memory #3 "account+8"` becomes `memory #3 "account.balance"`.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::tools {

/// By the program's debugging information, as gdb reads it. Names stay as they are where there is none, or no gdb.
std::string with_fields(std::string text, const std::filesystem::path& program);

}  // namespace waitpoint::tools
