// SPDX-License-Identifier: BSD-3-Clause
//
// stat() and the like.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

timespec as_timespec(const statx_timestamp& date) { return {date.tv_sec, static_cast<long>(date.tv_nsec)}; }

// The headers declare both structures, of the same members.
static_assert(sizeof(struct stat) == sizeof(struct stat64) &&
              offsetof(struct stat, st_ino) == offsetof(struct stat64, st_ino));

void convert(const struct statx& from, struct stat64& to) {
  to = {};
  to.st_dev = makedev(from.stx_dev_major, from.stx_dev_minor);
  to.st_ino = from.stx_ino;
  to.st_mode = from.stx_mode;
  to.st_nlink = from.stx_nlink;
  to.st_uid = from.stx_uid;
  to.st_gid = from.stx_gid;
  to.st_rdev = makedev(from.stx_rdev_major, from.stx_rdev_minor);
  to.st_size = static_cast<off64_t>(from.stx_size);
  to.st_blksize = static_cast<blksize_t>(from.stx_blksize);
  to.st_blocks = static_cast<blkcnt64_t>(from.stx_blocks);
  to.st_atim = as_timespec(from.stx_atime);
  to.st_mtim = as_timespec(from.stx_mtime);
  to.st_ctim = as_timespec(from.stx_ctime);
}

int look_up(int folder, const char* path, int flags, struct stat64* state) {
  if (!is_simulated()) return WAITPOINT_NEXT(fstatat64)(folder, path, state, flags);
  if (!can_be_written(state)) return fail(EFAULT);
  before_call<"stat">([&] { return reading_name(folder, path, (flags & AT_SYMLINK_NOFOLLOW) == 0); });
  struct statx found {};
  int error = ask_system(folder, path, flags | AT_NO_AUTOMOUNT, found);
  if (error != EFAULT && std::strncmp(path, "/proc/", 6) == 0)
    error = ask_system(folder, PathInSystem(path).get(), flags | AT_NO_AUTOMOUNT, found);
  if (error != 0) return fail(error);
  replace_with_own(found);
  convert(found, *state);
  return 0;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

// Under the C library's names: its headers redirect those without a size to the others; the last ones are called by
// programs that were linked with older C libraries.
#define WAITPOINT_SAME_AS(name) extern "C" [[gnu::visibility("default"), gnu::alias(#name)]]

WAITPOINT_INTERPOSED int stat64(const char* __restrict path, struct stat64* __restrict state) noexcept {
  return look_up(AT_FDCWD, path, 0, state);
}
WAITPOINT_SAME_AS(stat64)
[[gnu::nonnull(1, 2)]] int waitpoint_stat(const char*, struct stat64*) noexcept __asm__("stat");
WAITPOINT_INTERPOSED int lstat64(const char* __restrict path, struct stat64* __restrict state) noexcept {
  return look_up(AT_FDCWD, path, AT_SYMLINK_NOFOLLOW, state);
}
WAITPOINT_SAME_AS(lstat64)
[[gnu::nonnull(1, 2)]] int waitpoint_lstat(const char*, struct stat64*) noexcept __asm__("lstat");
WAITPOINT_INTERPOSED int fstat64(int descriptor, struct stat64* state) noexcept {
  return descriptor < 0 ? fail(EBADF) : look_up(descriptor, "", AT_EMPTY_PATH, state);
}
WAITPOINT_SAME_AS(fstat64) [[gnu::nonnull(2)]] int waitpoint_fstat(int, struct stat64*) noexcept __asm__("fstat");
WAITPOINT_INTERPOSED int fstatat64(int folder, const char* __restrict path, struct stat64* __restrict state,
                                   int flags) noexcept {
  return look_up(folder, path, flags, state);
}
WAITPOINT_SAME_AS(fstatat64)
[[gnu::nonnull(2, 3)]] int waitpoint_fstatat(int, const char*, struct stat64*, int) noexcept __asm__("fstatat");

WAITPOINT_INTERPOSED int statx(int folder, const char* __restrict path, int flags, unsigned wanted,
                               struct statx* __restrict state) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(statx)(folder, path, flags, wanted, state);
  before_call<"statx">([&] { return reading_name(folder, path, (flags & AT_SYMLINK_NOFOLLOW) == 0); });
  const PathInSystem in_system(path);
  if (WAITPOINT_NEXT(statx)(folder, in_system.get(), flags, wanted | wanted_of_file, state) != 0) return -1;
  replace_with_own(*state);
  return 0;
}

WAITPOINT_INTERPOSED int __xstat64(int, const char* path, struct stat64* state) noexcept { return stat64(path, state); }
WAITPOINT_INTERPOSED int __xstat(int, const char* path, struct stat64* state) noexcept { return stat64(path, state); }
WAITPOINT_INTERPOSED int __lxstat64(int, const char* path, struct stat64* state) noexcept {
  return lstat64(path, state);
}
WAITPOINT_INTERPOSED int __lxstat(int, const char* path, struct stat64* state) noexcept { return lstat64(path, state); }
WAITPOINT_INTERPOSED int __fxstat64(int, int descriptor, struct stat64* state) noexcept {
  return fstat64(descriptor, state);
}
WAITPOINT_INTERPOSED int __fxstat(int, int descriptor, struct stat64* state) noexcept {
  return fstat64(descriptor, state);
}
WAITPOINT_INTERPOSED int __fxstatat64(int, int folder, const char* path, struct stat64* state, int flags) noexcept {
  return fstatat64(folder, path, state, flags);
}
WAITPOINT_INTERPOSED int __fxstatat(int, int folder, const char* path, struct stat64* state, int flags) noexcept {
  return fstatat64(folder, path, state, flags);
}
