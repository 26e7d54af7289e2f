// SPDX-License-Identifier: BSD-3-Clause
// Functions that replace the C library's in a program that `waitpoint exec` runs.
//
// The library is preloaded: the program's calls to these names reach it, the C library's internal calls do not. It
// shares nothing with the program's C++ runtime: it throws nothing, registers nothing at exit, has no guarded statics,
// and exports only the names marked here.
#pragma once

#include <dlfcn.h>

#include "core/error.hpp"

/// Marks a definition that replaces the C library's.
#define WAITPOINT_INTERPOSED extern "C" [[gnu::visibility("default")]]

/// The C library's dlsym(): see lookups.cpp.
extern "C" [[gnu::visibility("hidden")]] void* waitpoint_own_dlsym();

namespace waitpoint::posix {

/// True if both addresses are of one loaded file.
bool are_of_one_library(const void* one, const void* other);

/// The replaced function of this name: the next one in the search order of the libraries.
template <class Function>
Function next(Function& known, const char* name) {
  if (known == nullptr) known = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
  WAITPOINT_CHECK(known != nullptr, "the C library lacks a function that the layer replaces");
  return known;
}

/// The C library's own function, even if another library defines the name too.
template <class Function>
Function of_c_library(Function, const char* name) {
  void* const library = dlopen("libc.so.6", RTLD_LAZY | RTLD_NOLOAD);
  WAITPOINT_CHECK(library != nullptr, "the process has no C library of the expected name");
  const auto look_up = reinterpret_cast<void* (*)(void*, const char*)>(waitpoint_own_dlsym());
  const auto found = reinterpret_cast<Function>(look_up(library, name));
  WAITPOINT_CHECK(found != nullptr, "the C library lacks a function that the layer calls");
  return found;
}

}  // namespace waitpoint::posix

/// The replaced function `name`, looked up once.
#define WAITPOINT_NEXT(name)                                \
  (::waitpoint::posix::next(                                \
      []() -> decltype(&::name)& {                          \
        static constinit decltype(&::name) known = nullptr; \
        return known;                                       \
      }(),                                                  \
      #name))
