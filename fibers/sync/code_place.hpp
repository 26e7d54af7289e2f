// SPDX-License-Identifier: BSD-3-Clause
// Where a call stands, in the words of the module that it is in: what is left of an address when the process is gone.
#pragma once

#include <cstdint>
#include <string>

namespace waitpoint::sync {

struct CodePlace {
  std::string module;  ///< its file; empty where none has the address
  std::uintptr_t offset = 0;
  std::string symbol;  ///< as the linker knows it; empty where it does not
};

/// A symbol as people write it: of C++ without its mangling, of C as it is.
std::string demangled(const std::string& symbol);

/// Of the call that returns to this address of this process.
CodePlace code_place_of(const void* return_address);

}  // namespace waitpoint::sync
