// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/family.hpp"

#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>

#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix::family {

Family* family = nullptr;
Process* own = nullptr;

namespace {

constexpr std::size_t page = 4096;
static_assert(family_address % page == 0 && family_bytes % page == 0, "the family's memory is mapped in whole pages");
static_assert(sizeof(Family) % Arena::alignment == 0, "the arena begins behind the family's record");

// Programs in the process of a host have no run's file, and no processes.
Family& memory() {
  if (family != nullptr) return *family;
  void* const pages = mmap(reinterpret_cast<void*>(family_address), family_bytes, PROT_READ | PROT_WRITE,
                           MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
  if (pages == MAP_FAILED) refuse("there is no address space for the memory shared by processes");
  family = new (pages) Family;
  family->arena.start(family + 1, static_cast<char*>(pages) + family_bytes);
  return *family;
}

}  // namespace

void* take(std::size_t bytes) {
  void* const piece = memory().arena.take(bytes);
  if (piece != nullptr) std::memset(piece, 0, bytes);
  return piece;
}

void* common(Part part, std::size_t bytes) {
  WAITPOINT_CHECK(part < Part::count, "a part of the layer has no place in the family's memory");
  void*& known = memory().parts[static_cast<int>(part)];
  if (known == nullptr && bytes > 0) known = take(bytes);
  return known;
}

void give(void* piece) {
  WAITPOINT_CHECK(family != nullptr, "memory is given back to a family that has not begun");
  WAITPOINT_CHECK(piece == nullptr || (piece > family && piece < family->arena.top()),
                  "memory given back is not the family's");
  family->arena.give(piece);
}

// The word in front of the first page holds the address of the arena's piece.
void* take_pages(std::size_t bytes) {
  if (bytes > family_bytes) return nullptr;
  auto* const piece = static_cast<char*>(memory().arena.take(bytes + 2 * page));
  if (piece == nullptr) return nullptr;
  char* const pages = reinterpret_cast<char*>((reinterpret_cast<std::uintptr_t>(piece) / page + 2) * page);
  reinterpret_cast<void**>(pages)[-1] = piece;
  madvise(pages, bytes, MADV_REMOVE);
  return pages;
}

void give_pages(void* pages, std::size_t bytes) {
  WAITPOINT_CHECK(reinterpret_cast<std::uintptr_t>(pages) % page == 0, "memory given back begins no page");
  void* const piece = static_cast<void**>(pages)[-1];
  WAITPOINT_CHECK(piece < pages && piece >= static_cast<char*>(pages) - 2 * page,
                  "the word in front of pages given back is no longer the address of their piece");
  madvise(pages, bytes, MADV_REMOVE);
  give(piece);
}

}  // namespace waitpoint::posix::family
