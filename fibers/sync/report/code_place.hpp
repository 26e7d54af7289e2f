// SPDX-License-Identifier: BSD-3-Clause
// A call's location by module and offset: valid after the process has ended, unlike an address.
#pragma once

#include <cstdint>
#include <string>

namespace waitpoint::sync {

struct CodePlace {
  std::string module;  ///< its file; empty if the address is in none
  std::uintptr_t offset = 0;
  std::string symbol;  ///< the linker's name; empty if unknown
};

/// A demangled C++ symbol; a C symbol unchanged.
std::string demangled(const std::string& symbol);

/// The location of the call that returns to this address of this process.
CodePlace code_place_of(const void* return_address);

}  // namespace waitpoint::sync
