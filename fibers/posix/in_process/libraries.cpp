// SPDX-License-Identifier: BSD-3-Clause
//
// dlopen() by a program: of a library that it is linked to, the program's copy; another library is copied for it. Where
// dladdr() finds a copy, it tells the file that was copied.
#include <dlfcn.h>

#include <climits>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/tail_call.hpp"
#include "fibers/posix/in_process/loaded_program.hpp"

WAITPOINT_TAIL_CALL(dlopen, waitpoint_open_copy, waitpoint_own_dlopen);

namespace waitpoint::posix {
namespace {

// The calls meanwhile are not the program's.
ObjectCopy* copy_for(LoadedProgram& program, const char* name, int mode) {
  const InKernel within;
  if (ObjectCopy* const copy = find_copy(program.image, name); copy != nullptr) return copy;
  return (mode & RTLD_NOLOAD) != 0 ? nullptr : open_library(program.image, name, mode & ~RTLD_LAZY);
}

void* handle_of(ObjectCopy& copy, int mode) {
  const InKernel within;
  return open_copy(copy, mode);
}

bool closes_copy(void* handle) {
  const InKernel within;
  return close_copy(this_loaded_program().image, handle);
}

void tell_file(const void* address, Dl_info& information) {
  if (const ObjectCopy* const copy = copy_with(this_loaded_program().image, address); copy != nullptr)
    information.dli_fname = copy->file;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

extern "C" {

// Null: not by the layer.
[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_open_copy(const char* name, int mode) {
  if (!runs_in_loaded_program()) return nullptr;
  LoadedProgram& program = this_loaded_program();
  // The program's working directory is another one than the layer's.
  char whole[PATH_MAX];
  const bool is_relative = name != nullptr && name[0] != '/' && std::strchr(name, '/') != nullptr;
  if (is_relative && realpath(name, whole) != nullptr) name = whole;
  const ObjectCopy* const before = program.image.last;
  ObjectCopy* const copy = copy_for(program, name, mode);
  if (copy == nullptr) return nullptr;
  call_constructors(program.image, before, program.argc, program.argv);
  return handle_of(*copy, mode);
}

[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_own_dlopen() {
  return reinterpret_cast<void*>(WAITPOINT_NEXT(dlopen));
}
}

WAITPOINT_INTERPOSED int dlclose(void* handle) noexcept {
  return runs_in_loaded_program() && closes_copy(handle) ? 0 : WAITPOINT_NEXT(dlclose)(handle);
}

WAITPOINT_INTERPOSED int dladdr(const void* address, Dl_info* information) noexcept {
  const int found = WAITPOINT_NEXT(dladdr)(address, information);
  if (found != 0 && runs_in_loaded_program()) tell_file(address, *information);
  return found;
}

WAITPOINT_INTERPOSED int dladdr1(const void* address, Dl_info* information, void** extra, int flags) noexcept {
  const int found = WAITPOINT_NEXT(dladdr1)(address, information, extra, flags);
  if (found != 0 && runs_in_loaded_program()) tell_file(address, *information);
  return found;
}
