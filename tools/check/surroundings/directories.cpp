// SPDX-License-Identifier: BSD-3-Clause
// Lists directory entries in reverse: programs must not rely on the file system's order.
//
// The first read of a directory reads all its entries:
//
//   entries  | dirent | dirent | dirent | ...          in a mapping of its own, grown by mremap
//                                  ^ left: entries before it remain to be returned
#undef _FILE_OFFSET_BITS  // otherwise <dirent.h> renames readdir to readdir64, and both are defined here
#include <dirent.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstring>

#include "tools/check/surroundings/next.hpp"

static_assert(sizeof(dirent) == sizeof(dirent64), "one layout for both names, as on every 64-bit system");

namespace waitpoint::surroundings {
namespace {

constinit Next<dirent*(DIR*)> next_readdir("readdir");
constinit Next<void(DIR*)> next_rewinddir("rewinddir");
constinit Next<int(DIR*)> next_closedir("closedir");

struct Listing {
  DIR* directory = nullptr;
  dirent* entries = nullptr;
  std::size_t room = 0;  // capacity, in entries
  std::size_t left = 0;
};

constexpr std::size_t first_room = 128;
constexpr std::size_t listings_max = 64;  // directories open beyond this number keep the system's order
constinit Listing listings[listings_max];
constinit std::atomic_flag taken;

Listing* find(DIR* directory) {
  for (Listing& listing : listings)
    if (listing.directory == directory) return &listing;
  return nullptr;
}

bool grow(Listing& listing) {
  const std::size_t room = listing.room == 0 ? first_room : listing.room * 2;
  void* const entries =
      listing.room == 0
          ? mmap(nullptr, room * sizeof(dirent), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
          : mremap(listing.entries, listing.room * sizeof(dirent), room * sizeof(dirent), MREMAP_MAYMOVE);
  if (entries == MAP_FAILED) return false;
  listing.entries = static_cast<dirent*>(entries);
  listing.room = room;
  return true;
}

void take_in(Listing& listing, DIR* directory) {
  listing.directory = directory;
  while (listing.left < listing.room || grow(listing)) {
    const dirent* const entry = next_readdir(directory);
    if (entry == nullptr) return;
    std::memcpy(&listing.entries[listing.left++], entry, entry->d_reclen);
  }
}

dirent* read(DIR* directory) {
  const Holding lock(taken);
  Listing* listing = find(directory);
  if (listing == nullptr) {
    listing = find(nullptr);
    if (listing == nullptr) return next_readdir(directory);
    take_in(*listing, directory);
  }
  return listing->left == 0 ? nullptr : &listing->entries[--listing->left];
}

void forget(DIR* directory) {
  const Holding lock(taken);
  Listing* const listing = find(directory);
  if (listing == nullptr) return;
  if (listing->room != 0) munmap(listing->entries, listing->room * sizeof(dirent));
  *listing = Listing();
}

}  // namespace
}  // namespace waitpoint::surroundings

extern "C" {

dirent* readdir(DIR* directory) { return waitpoint::surroundings::read(directory); }

dirent64* readdir64(DIR* directory) { return reinterpret_cast<dirent64*>(waitpoint::surroundings::read(directory)); }

void rewinddir(DIR* directory) noexcept {
  waitpoint::surroundings::forget(directory);
  waitpoint::surroundings::next_rewinddir(directory);
}

int closedir(DIR* directory) {
  waitpoint::surroundings::forget(directory);
  return waitpoint::surroundings::next_closedir(directory);
}
}
