// SPDX-License-Identifier: BSD-3-Clause
//
// Calls by path, in /proc: the folders of processes have the simulation's numbers, and so have the links in them.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

// A text in place of the system's: "1000" for /proc/self, "pipe:[20]" for the system's number of a pipe. Empty if the
// system's remains.
void write_own_link(const char* path, const char* system, char (&own)[64]) {
  own[0] = '\0';
  const auto id = static_cast<int>(family::own->id);
  if (std::strcmp(path, "/proc/self") == 0) std::snprintf(own, sizeof own, "%d", id);
  if (std::strcmp(path, "/proc/thread-self") == 0) std::snprintf(own, sizeof own, "%d/task/%d", id, this_thread().id);
  // A link to a folder of the own process.
  char* behind = nullptr;
  if (std::strncmp(system, "/proc/", 6) == 0 && std::strtol(system + 6, &behind, 10) == family::own->real_id.load())
    std::snprintf(own, sizeof own, "/proc/%d%.40s", id, behind);
  const char* const colon = std::strstr(system, ":[");
  if (colon == nullptr || (std::strncmp(system, "pipe", 4) != 0 && std::strncmp(system, "socket", 6) != 0)) return;
  struct statx state {};
  if (ask_system(AT_FDCWD, path, 0, state) != 0) return;
  const FileRecord* const file = look_at(state);
  if (file == nullptr) return;
  std::snprintf(own, sizeof own, "%.*s:[%llu]", static_cast<int>(colon - system), system,
                static_cast<unsigned long long>(file->number));
}

ssize_t read_link(int folder, const char* path, char* text, std::size_t size) {
  before_call<"readlink">([&] { return reading_name(folder, path, false); });
  if (!is_simulated() || !is_in_proc(path) || ProcessPath(path).process == nullptr)
    return WAITPOINT_NEXT(readlinkat)(folder, path, text, size);
  const PathInSystem in_system(path);
  char system[PATH_MAX + 1], own[64];
  const ssize_t length = WAITPOINT_NEXT(readlinkat)(folder, in_system.get(), system, sizeof system - 1);
  if (length <= 0) return length;
  system[length] = '\0';
  write_own_link(in_system.get(), system, own);
  const char* const told = own[0] != '\0' ? own : system;
  const std::size_t told_length = std::min(std::strlen(told), size);
  if (size == 0) return fail(EINVAL);
  if (!can_be_written(text, told_length)) return fail(EFAULT);
  std::copy_n(told, told_length, text);  // no null at its end
  return static_cast<ssize_t>(told_length);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED ssize_t readlink(const char* __restrict path, char* __restrict text, std::size_t size) noexcept {
  return read_link(AT_FDCWD, path, text, size);
}
WAITPOINT_INTERPOSED ssize_t readlinkat(int folder, const char* __restrict path, char* __restrict text,
                                        std::size_t size) noexcept {
  return read_link(folder, path, text, size);
}
WAITPOINT_INTERPOSED int access(const char* path, int mode) noexcept {
  before_call<"access">([&] { return reading_name(AT_FDCWD, path); });
  return WAITPOINT_NEXT(access)(PathInSystem(path).get(), mode);
}
WAITPOINT_INTERPOSED int faccessat(int folder, const char* path, int mode, int flags) noexcept {
  before_call<"faccessat">([&] { return reading_name(folder, path, (flags & AT_SYMLINK_NOFOLLOW) == 0); });
  return WAITPOINT_NEXT(faccessat)(folder, PathInSystem(path).get(), mode, flags);
}
