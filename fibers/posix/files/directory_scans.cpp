// SPDX-License-Identifier: BSD-3-Clause
//
// scandir(), which the C library does with a readdir() of its own.
#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

using Select = int (*)(const dirent64*);
using Compare = int (*)(const dirent64**, const dirent64**);

/// The entries found so far, for the caller.
struct Found {
  dirent64** entries = nullptr;
  std::size_t count = 0, room = 0;

  bool add(const dirent64& entry) {
    if (count == room) {
      const std::size_t larger = room > 0 ? 2 * room : 16;
      auto** const moved = static_cast<dirent64**>(std::realloc(entries, larger * sizeof(void*)));
      if (moved == nullptr) return false;
      entries = moved;
      room = larger;
    }
    entries[count] = static_cast<dirent64*>(std::malloc(entry.d_reclen));
    if (entries[count] == nullptr) return false;
    std::memcpy(static_cast<void*>(entries[count++]), &entry, entry.d_reclen);
    return true;
  }
  void drop() {
    for (std::size_t i = 0; i < count; ++i) std::free(entries[i]);
    std::free(entries);
  }
};

int scan(DIR* directory, dirent64*** result, Select select, Compare compare) {
  Found found;
  const int error_before = errno;
  errno = 0;
  while (const dirent64* const entry = readdir64(directory)) {
    const bool is_selected = select == nullptr || select(entry) != 0;
    errno = 0;  // of the caller's function
    if (is_selected && !found.add(*entry)) errno = ENOMEM;
    if (errno != 0) break;
  }
  const int error = errno;
  closedir(directory);
  if (error != 0) {
    found.drop();
    return fail(error);
  }
  errno = error_before;
  if (compare != nullptr && found.count > 0)
    std::qsort(found.entries, found.count, sizeof(void*), reinterpret_cast<int (*)(const void*, const void*)>(compare));
  *result = found.entries;
  return static_cast<int>(found.count);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

// Under the C library's names: its headers redirect those without a size to the others.
#define WAITPOINT_SAME_AS(name) extern "C" [[gnu::visibility("default"), gnu::alias(#name)]]

WAITPOINT_INTERPOSED int scandir64(const char* __restrict path, dirent64*** __restrict result, Select select,
                                   Compare compare) {
  if (!is_simulated()) return WAITPOINT_NEXT(scandir64)(path, result, select, compare);
  DIR* const directory = opendir(path);
  return directory != nullptr ? scan(directory, result, select, compare) : -1;
}
WAITPOINT_SAME_AS(scandir64)
[[gnu::nonnull(1, 2)]] int waitpoint_scandir(const char*, dirent64***, Select, Compare) __asm__("scandir");
WAITPOINT_INTERPOSED int scandirat64(int folder, const char* __restrict path, dirent64*** __restrict result,
                                     Select select, Compare compare) {
  if (!is_simulated()) return WAITPOINT_NEXT(scandirat64)(folder, path, result, select, compare);
  const int descriptor = openat(folder, path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return -1;
  DIR* const directory = fdopendir(descriptor);
  if (directory != nullptr) return scan(directory, result, select, compare);
  const ErrorNumberKept kept;
  close(descriptor);
  return -1;
}
WAITPOINT_SAME_AS(scandirat64)
[[gnu::nonnull(2, 3)]] int waitpoint_scandirat(int, const char*, dirent64***, Select, Compare) __asm__("scandirat");
