// SPDX-License-Identifier: BSD-3-Clause
//
// Calls by which memory becomes code. A program that makes its own code writable is about to change it.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstring>

#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/traps/access_breakpoints.hpp"
#include "fibers/posix/traps/generated_code.hpp"

namespace waitpoint::posix {
namespace {

// A file of code that is mapped as such: by a program's own loader, or again by a library that is loaded.
bool is_compiled(int file) {
  char magic[4];
  return call_directly(SYS_pread64, file, reinterpret_cast<long>(magic), sizeof magic, 0) == sizeof magic &&
         std::memcmp(magic, "\177ELF", sizeof magic) == 0;
}

}  // namespace

WAITPOINT_INTERPOSED int mprotect(void* begin, std::size_t bytes, int protection) noexcept {
  if ((protection & PROT_WRITE) != 0) prevent_breakpoints_in(begin, bytes);
  const auto result = static_cast<int>(WAITPOINT_NEXT(syscall)(SYS_mprotect, begin, bytes, protection));
  if (result == 0 && (protection & PROT_EXEC) != 0) note_executable(begin, bytes);
  return result;
}

WAITPOINT_INTERPOSED void* mmap(void* wish, std::size_t bytes, int protection, int flags, int file,
                                off_t from) noexcept {
  void* const memory =
      reinterpret_cast<void*>(WAITPOINT_NEXT(syscall)(SYS_mmap, wish, bytes, protection, flags, file, from));
  if (memory != MAP_FAILED && (protection & PROT_EXEC) != 0 && ((flags & MAP_ANONYMOUS) != 0 || !is_compiled(file)))
    note_executable(memory, bytes);
  return memory;
}

WAITPOINT_INTERPOSED void* mmap64(void* wish, std::size_t bytes, int protection, int flags, int file,
                                  off64_t from) noexcept {
  return mmap(wish, bytes, protection, flags, file, from);
}

}  // namespace waitpoint::posix
