// SPDX-License-Identifier: BSD-3-Clause
// What stands before the C library in a program that `waitpoint exec` runs.
//
// The library is preloaded, so that the program's calls of these names come here; the C library's calls of its own do
// not. It shares nothing with the program's C++ runtime: it throws nothing, registers nothing at exit, has no guarded
// statics, and only the names marked here are seen from outside.
#pragma once

#include <dlfcn.h>

#include "core/error.hpp"

/// In front of a definition that takes the place of the C library's.
#define WAITPOINT_INTERPOSED extern "C" [[gnu::visibility("default")]]

namespace waitpoint::posix {

/// The function of this name behind ours.
template <class Function>
Function next(Function& known, const char* name) {
  if (known == nullptr) known = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
  WAITPOINT_CHECK(known != nullptr, "the C library lacks a function that stands behind a simulated one");
  return known;
}

/// The C library's own, whatever library has one too: see lookups.cpp.
template <class Function>
Function of_c_library(Function, const char* name) {
  return reinterpret_cast<Function>(dlsym(dlopen("libc.so.6", RTLD_LAZY | RTLD_NOLOAD), name));
}

}  // namespace waitpoint::posix

/// A call of the C library's own function of this name.
#define WAITPOINT_NEXT(name)                                \
  (::waitpoint::posix::next(                                \
      []() -> decltype(&::name)& {                          \
        static constinit decltype(&::name) known = nullptr; \
        return known;                                       \
      }(),                                                  \
      #name))
