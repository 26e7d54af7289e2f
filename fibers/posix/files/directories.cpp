// SPDX-License-Identifier: BSD-3-Clause
//
// Directories are read in the order of the names: the system's order depends on the file system's history. The entries
// are those at the first reading after opendir() or rewinddir(). In /proc, processes are those of the family.
#include <dirent.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

static_assert(sizeof(dirent) == sizeof(dirent64) && offsetof(dirent, d_name) == offsetof(dirent64, d_name));

/// The entries of an open directory.
struct Listing {
  const DIR* directory;
  std::uint64_t device;
  dirent64** entries;
  long count, room, next;
  Listing* behind;
};
Listing* first_listing = nullptr;

bool add(Listing& listing, const dirent64& entry) {
  if (listing.count == listing.room) {
    const long room = listing.room > 0 ? 2 * listing.room : 16;
    auto* const larger =
        static_cast<dirent64**>(std::realloc(listing.entries, static_cast<std::size_t>(room) * sizeof(void*)));
    if (larger == nullptr) return false;
    listing.entries = larger;
    listing.room = room;
  }
  const std::size_t size = offsetof(dirent64, d_name) + std::strlen(entry.d_name) + 1;
  auto* const copy = static_cast<dirent64*>(std::malloc(size));
  if (copy == nullptr) return false;
  std::memcpy(static_cast<void*>(copy), &entry, size);
  listing.entries[listing.count++] = copy;
  return true;
}

bool add_number(Listing& listing, int number) {
  dirent64 entry{};
  entry.d_ino = static_cast<ino64_t>(number);
  entry.d_type = DT_DIR;
  std::snprintf(entry.d_name, sizeof entry.d_name, "%d", number);
  return add(listing, entry);
}

/// Folders whose entries are numbers of processes or threads.
enum class Numbered { no, processes, threads };
Numbered numbers_in(int descriptor) {
  struct statfs of {};
  if (family::own == nullptr || WAITPOINT_NEXT(fstatfs)(descriptor, &of) != 0 || of.f_type != PROC_SUPER_MAGIC)
    return Numbered::no;
  char link[40], path[64];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = WAITPOINT_NEXT(readlink)(link, path, sizeof path - 1);
  if (size <= 0) return Numbered::no;
  path[size] = '\0';
  if (std::strcmp(path, "/proc") == 0) return Numbered::processes;
  const char* const last = std::strrchr(path, '/');
  return std::strcmp(last, "/task") == 0 && std::atoi(path + std::strlen("/proc/")) == family::own->real_id.load()
             ? Numbered::threads
             : Numbered::no;
}

bool add_numbers(Listing& listing, Numbered numbered) {
  bool has_room = true;
  if (numbered == Numbered::processes)
    for (const family::Process& each : family::entries())
      if (each.state != family::Process::State::none) has_room = has_room && add_number(listing, each.id);
  if (numbered == Numbered::threads)
    for (const kernel::Task* task = first_task(); task != nullptr; task = task->next)
      if (is_thread(*task)) has_room = has_room && add_number(listing, thread_of(*task).id);
  return has_room;
}

// "." and ".." come first.
bool is_before(const dirent64* one, const dirent64* other) {
  const auto rank = [](const char* name) {
    return std::strcmp(name, ".") == 0 ? 0 : std::strcmp(name, "..") == 0 ? 1 : 2;
  };
  const int first = rank(one->d_name), second = rank(other->d_name);
  return first != second ? first < second : std::strcmp(one->d_name, other->d_name) < 0;
}

// 0, or an error number.
int fill(Listing& listing, DIR* directory) {
  struct statx state {};
  if (ask_system(dirfd(directory), "", AT_EMPTY_PATH, state) == 0) listing.device = device_of(state);
  const Numbered numbered = numbers_in(dirfd(directory));
  errno = 0;
  while (const dirent64* const entry = WAITPOINT_NEXT(readdir64)(directory)) {
    if (numbered != Numbered::no && entry->d_name[0] >= '1' && entry->d_name[0] <= '9') continue;
    if (!add(listing, *entry)) return ENOMEM;
  }
  if (errno != 0) return errno;
  if (!add_numbers(listing, numbered)) return ENOMEM;
  std::sort(listing.entries, listing.entries + listing.count, is_before);
  return 0;
}

Listing* find_listing(const DIR* directory) {
  Listing* each = first_listing;
  while (each != nullptr && each->directory != directory) each = each->behind;
  return each;
}

void drop_listing(const DIR* directory) {
  Listing** link = &first_listing;
  while (*link != nullptr && (*link)->directory != directory) link = &(*link)->behind;
  Listing* const dropped = *link;
  if (dropped == nullptr) return;
  *link = dropped->behind;
  for (long i = 0; i < dropped->count; ++i) std::free(dropped->entries[i]);
  std::free(dropped->entries);
  std::free(dropped);
}

// Null, with errno set, if it cannot be read.
Listing* listing_of(DIR* directory) {
  if (Listing* const known = find_listing(directory); known != nullptr) return known;
  const int error = errno;
  auto* const made = static_cast<Listing*>(std::calloc(1, sizeof(Listing)));
  if (made == nullptr) return nullptr;
  made->directory = directory;
  made->behind = first_listing;
  first_listing = made;
  const int failed = fill(*made, directory);
  if (failed != 0) drop_listing(directory);
  errno = failed != 0 ? failed : error;
  return failed != 0 ? nullptr : made;
}

// Of "..", which may be on another device, the folder does not tell.
std::uint64_t number_in(const Listing& listing, const dirent64& entry) {
  if (std::strcmp(entry.d_name, "..") != 0) return number_of(listing.device, entry.d_ino);
  struct statx state {};
  const int flags = AT_SYMLINK_NOFOLLOW | AT_NO_AUTOMOUNT;
  const int error = ask_system(dirfd(const_cast<DIR*>(listing.directory)), entry.d_name, flags, state);
  const FileRecord* const file = error == 0 ? look_at(state) : nullptr;
  return file != nullptr ? file->number : 0;
}

dirent64* next_entry(DIR* directory) {
  Listing* const listing = listing_of(directory);
  if (listing == nullptr || listing->next >= listing->count) return nullptr;
  dirent64& entry = *listing->entries[listing->next++];
  if (const std::uint64_t number = number_in(*listing, entry); number != 0) entry.d_ino = number;
  entry.d_off = listing->next;
  return &entry;
}

int copy_next_entry(DIR* directory, dirent64* entry, dirent64** result) {
  const int error = errno;
  errno = 0;
  const dirent64* const next = readdir64(directory);
  const int failed = next == nullptr ? errno : 0;
  errno = error;
  if (next != nullptr) std::memcpy(static_cast<void*>(entry), next, next->d_reclen);
  *result = next != nullptr ? entry : nullptr;
  return failed;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

// Under the C library's names: its headers redirect those without a size to the others.
#define WAITPOINT_SAME_AS(name) extern "C" [[gnu::visibility("default"), gnu::alias(#name)]]

WAITPOINT_INTERPOSED DIR* opendir(const char* path) {
  before_call<"opendir">([&] { return opening(AT_FDCWD, path, O_RDONLY); });
  return WAITPOINT_NEXT(opendir)(PathInSystem(path).get());
}
WAITPOINT_INTERPOSED dirent64* readdir64(DIR* directory) {
  before_call<"readdir">([&] { return reading_entries(dirfd(directory)); });
  return is_simulated() ? next_entry(directory) : WAITPOINT_NEXT(readdir64)(directory);
}
WAITPOINT_SAME_AS(readdir64) [[gnu::nonnull(1)]] dirent64* waitpoint_readdir(DIR*) __asm__("readdir");
// Deprecated by their header.
extern "C" {
[[gnu::visibility("default")]] int waitpoint_readdir_r(DIR*, dirent64*, dirent64**) __asm__("readdir_r");
[[gnu::visibility("default")]] int waitpoint_readdir64_r(DIR*, dirent64*, dirent64**) __asm__("readdir64_r");
}
int waitpoint_readdir_r(DIR* directory, dirent64* entry, dirent64** result) {
  return copy_next_entry(directory, entry, result);
}
int waitpoint_readdir64_r(DIR* directory, dirent64* entry, dirent64** result) {
  return copy_next_entry(directory, entry, result);
}
WAITPOINT_INTERPOSED void rewinddir(DIR* directory) noexcept {
  before_call<"rewinddir">([&] { return reading_entries(dirfd(directory)); });
  drop_listing(directory);
  WAITPOINT_NEXT(rewinddir)(directory);
}
WAITPOINT_INTERPOSED long telldir(DIR* directory) noexcept {
  before_call<"telldir">([&] { return reading_entries(dirfd(directory)); });
  if (!is_simulated()) return WAITPOINT_NEXT(telldir)(directory);
  const Listing* const listing = find_listing(directory);
  return listing != nullptr ? listing->next : 0;
}
WAITPOINT_INTERPOSED void seekdir(DIR* directory, long to) noexcept {
  before_call<"seekdir">([&] { return reading_entries(dirfd(directory)); });
  if (!is_simulated()) return WAITPOINT_NEXT(seekdir)(directory, to);
  Listing* const listing = listing_of(directory);
  if (listing != nullptr && to >= 0) listing->next = to;
}
WAITPOINT_INTERPOSED int closedir(DIR* directory) {
  before_call<"closedir">(changing(place::descriptors));
  drop_listing(directory);
  return WAITPOINT_NEXT(closedir)(directory);
}
