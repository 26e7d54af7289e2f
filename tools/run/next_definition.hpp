// SPDX-License-Identifier: BSD-3-Clause
// The C library's function behind one that this program defines in its place: exit_calls.cpp, signal_calls.cpp.
#pragma once

#include <dlfcn.h>

namespace waitpoint::tools {

/// The next definition of `name` after the program's own.
template <class Function>
Function* next_definition(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace waitpoint::tools
