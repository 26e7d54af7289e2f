// SPDX-License-Identifier: BSD-3-Clause
// The inode numbers and times of files, as the processes of the program see them.
//
// Inodes are numbered in the order in which the program sees them first; the system reuses its own. A file that the
// program has changed shows the virtual date at which it did: noted when it makes, truncates and closes the file, at
// the latest when it looks at it next. Others keep their dates. The time of the last access is that of the last change,
// as on file systems that do not keep it.
#pragma once

#include <sys/stat.h>

#include <cstdint>

namespace waitpoint::posix {

struct FileRecord {
  std::uint64_t device, inode;  ///< the key, of the system
  /// The date of birth tells files apart that had the same inode one after the other; 0: it is not known.
  std::int64_t born_ns;

  std::uint64_t number;  ///< of the inode; 0: the record is free
  // Dates in nanoseconds: those that the program sees once it has changed the file, and the system's at that time.
  std::int64_t modified_ns, changed_ns, accessed_ns;
  std::int64_t modified_in_system_ns, changed_in_system_ns;
};

inline std::int64_t ns_of(const statx_timestamp& date) {
  return date.tv_sec * std::int64_t{1'000'000'000} + date.tv_nsec;
}
/// What statx() is asked for.
inline constexpr unsigned wanted_of_file = STATX_BASIC_STATS | STATX_BTIME;
/// As statx() for that. Returns 0 or an error number.
int ask_system(int folder, const char* path, int flags, struct statx& state);

/// The record of a file in this state, made if it is new, with a change noted that it shows; null without memory.
FileRecord* look_at(const struct statx& state);
/// The number of an inode that the program finds in a folder; 0 without memory.
std::uint64_t number_of(std::uint64_t device, std::uint64_t inode);
/// The first argument of number_of().
std::uint64_t device_of(const struct statx& state);
/// Replaces what the program does not see of the system's state.
void replace_with_own(struct statx& state);
/// The program has opened a file for writing, and may have made or truncated it.
void note_opened(int descriptor);
/// Before a run in this process: files have no records, and were not changed by it.
void forget_files();
/// A descriptor is a copy of another one.
void note_copy(int from, int made);
/// The program is about to close a file; without an effect if it was not opened for writing.
void note_closing(int descriptor);
/// It has written to a file by a descriptor that may be another process's.
void note_written(int descriptor);
/// It is about to close all.
void note_closing_all();

}  // namespace waitpoint::posix
