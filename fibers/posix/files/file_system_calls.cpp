// SPDX-License-Identifier: BSD-3-Clause
//
// System calls about files, by number, that the functions of their names answer otherwise than the system.
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <sys/time.h>
#include <unistd.h>
#include <utime.h>

#include <cstddef>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/repeatability.hpp"

namespace waitpoint::posix {
namespace {

// In the order of the file system.
long read_entries(const CallWords& words) {
  note_unrepeatable("the order of getdents64()");
  const long size = WAITPOINT_NEXT(syscall)(SYS_getdents64, words.at[0], words.at[1], words.at[2]);
  struct statx state {};
  if (size <= 0 || ask_system(words.word<int>(0), "", AT_EMPTY_PATH, state) != 0) return size;
  auto* const bytes = words.word<char*>(1);
  for (long at = 0; at < size;) {
    auto* const entry = reinterpret_cast<dirent64*>(bytes + at);
    if (const std::uint64_t number = number_of(device_of(state), entry->d_ino); number != 0) entry->d_ino = number;
    at += entry->d_reclen;
  }
  return size;
}

long look(int folder, const CallWords& words, int path, int flags) {
  return fstatat(folder, words.word<const char*>(path), words.word<struct stat*>(path + 1), flags);
}

}  // namespace

std::optional<long> call_about_files(long number, const CallWords& words) {
  if (!is_simulated()) return std::nullopt;
  switch (number) {
    case SYS_stat: return look(AT_FDCWD, words, 0, 0);
    case SYS_lstat: return look(AT_FDCWD, words, 0, AT_SYMLINK_NOFOLLOW);
    case SYS_fstat: return fstat(words.word<int>(0), words.word<struct stat*>(1));
    case SYS_newfstatat: return look(words.word<int>(0), words, 1, words.word<int>(3));
    case SYS_statx: return words.call(statx);
    case SYS_statfs: return statfs(words.word<const char*>(0), words.word<struct statfs*>(1));
    case SYS_fstatfs: return fstatfs(words.word<int>(0), words.word<struct statfs*>(1));
    case SYS_sysinfo: return sysinfo(words.word<struct sysinfo*>(0));
    case SYS_readlink: return words.call(readlink);
    case SYS_readlinkat: return words.call(readlinkat);
    case SYS_access: return words.call(access);
    case SYS_faccessat: return faccessat(words.word<int>(0), words.word<const char*>(1), words.word<int>(2), 0);
    case SYS_utimensat: return words.call(utimensat);
    case SYS_utimes: return utimes(words.word<const char*>(0), words.word<const timeval*>(1));
    case SYS_utime: return words.call(utime);
    case SYS_getdents64: return read_entries(words);
    default: return std::nullopt;
  }
}

}  // namespace waitpoint::posix
