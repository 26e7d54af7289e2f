// SPDX-License-Identifier: BSD-3-Clause
// The variable at an address of a file: also one that the linker keeps for debuggers alone, as most of a program's.
#pragma once

#include <cstdint>
#include <string>

namespace waitpoint::races {

/// "counter", "table + 8", demangled; empty if the file has no symbol there. `offset`: from where it is loaded.
std::string data_symbol(const std::string& file, std::uintptr_t offset);

}  // namespace waitpoint::races
