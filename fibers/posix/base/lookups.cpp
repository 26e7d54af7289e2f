// SPDX-License-Identifier: BSD-3-Clause
//
// dlsym(): a library that wraps pthread_create(), as allocators and profilers do, looks up the next definition. Behind
// the program's libraries that would be the C library's, which makes a system thread; the lookup returns ours instead.
// So do lookups in the C library itself, as of Python's ctypes: they return the functions that replace its own.
#include <dlfcn.h>
#include <pthread.h>

#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/tail_call.hpp"

WAITPOINT_TAIL_CALL(dlsym, waitpoint_ours_behind, waitpoint_own_dlsym);

namespace waitpoint::posix {

bool are_of_one_library(const void* one, const void* other) {
  Dl_info first{}, second{};
  return dladdr(one, &first) != 0 && dladdr(other, &second) != 0 && first.dli_fbase == second.dli_fbase;
}

namespace {

// The layer's library is searched first, then those that it needs. If a library of the program defines the name too, it
// may call what it finds, and be called by ours: it gets the C library's.
void* ours_in_place_of_c_library(void* library, const char* name) {
  const auto look_up = reinterpret_cast<void* (*)(void*, const char*)>(waitpoint_own_dlsym());
  static constinit void* own_library = nullptr;
  static constexpr char of_own = 0;
  Dl_info own{};
  if (own_library == nullptr && dladdr(&of_own, &own) != 0)
    own_library = dlopen(own.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  if (own_library == nullptr) return nullptr;
  void* const found = look_up(library, name);
  if (found == nullptr || !are_of_one_library(found, reinterpret_cast<const void*>(WAITPOINT_NEXT(abort))))
    return nullptr;
  void* const ours = look_up(own_library, name);
  if (ours == found || !are_of_one_library(ours, &of_own)) return nullptr;
  return look_up(RTLD_NEXT, name) == found ? ours : nullptr;
}

}  // namespace
}  // namespace waitpoint::posix

extern "C" {

// Of threads/thread.cpp.
[[gnu::visibility("hidden")]] int waitpoint_own_pthread_create(pthread_t* id, const pthread_attr_t* attributes,
                                                               void* (*start)(void*), void* argument) noexcept;

[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_ours_behind(void* where, const char* name) {
  if (name == nullptr || where == RTLD_DEFAULT) return nullptr;
  if (where != RTLD_NEXT) return waitpoint::posix::ours_in_place_of_c_library(where, name);
  return std::strcmp(name, "pthread_create") == 0 ? reinterpret_cast<void*>(&waitpoint_own_pthread_create) : nullptr;
}

// dlvsym() finds it by its version, without a call to dlsym().
[[gnu::used]] void* waitpoint_own_dlsym() {
  static constinit void* known = nullptr;
  for (const char* const version : {"GLIBC_2.34", "GLIBC_2.2.5"})
    if (known == nullptr) known = dlvsym(RTLD_NEXT, "dlsym", version);
  WAITPOINT_CHECK(known != nullptr, "the C library has no dlsym() of a version known here");
  return known;
}
}
