// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/waitable.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <bit>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "fibers/posix/base/symbols.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t cells_at_once = 4096, page_bytes = 4096;

union Cell {
  Cell* next_free;
  char bytes[waitable_bytes_max];
};
static_assert(sizeof(Cell) == waitable_bytes_max && sizeof(Waitable) <= waitable_bytes_max);

Cell* first_free = nullptr;
std::size_t cells_left = 0;  // of the memory allocated last
Cell* next_cell = nullptr;

// A hash table by address, with at least one bucket for each waitable.
Waitable** buckets = nullptr;
std::size_t bucket_count = 0;
std::size_t kept = 0;

// A bit for each page with a waitable's address, by a hash: set for good.
constexpr std::size_t page_bits = 1 << 16;
std::uint64_t pages_with[page_bits / 64];
std::uint64_t& word_of_page(std::uintptr_t page) { return pages_with[page % page_bits / 64]; }

// An address that no program uses: holes may be reserved by the program.
constexpr std::uintptr_t first_pages = 0x2b00'0000'0000;
static_assert(first_pages >= record_address + 2 * record_bytes, "they begin behind the record and the family's memory");
std::uintptr_t next_pages = first_pages;

// Reserved at the beginning, and used page by page: a program that exhausts its memory, its address space or the number
// of its mappings can use new primitives nevertheless, as these need no memory outside of it.
constexpr std::size_t reserved_bytes = std::size_t{1} << 34;
std::uintptr_t reserved_end = first_pages;

void* pages(std::size_t bytes) {
  reserve_waitables();
  const std::size_t whole = (bytes + 4095) / 4096 * 4096;
  void* memory = reinterpret_cast<void*>(next_pages);
  if (whole > reserved_end - next_pages && next_pages < reserved_end) next_pages = reserved_end;
  if (next_pages >= reserved_end)
    memory =
        mmap(reinterpret_cast<void*>(next_pages), whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  next_pages += whole;
  if (memory == MAP_FAILED) refuse("there is no memory for the program's primitives");
  return memory;
}

Cell* take_cell() {
  if (Cell* cell = first_free; cell != nullptr) {
    first_free = cell->next_free;
    return cell;
  }
  if (cells_left == 0) {
    next_cell = static_cast<Cell*>(pages(cells_at_once * sizeof(Cell)));
    cells_left = cells_at_once;
  }
  WAITPOINT_CHECK(next_cell != nullptr, "cells are left of no memory");
  --cells_left;
  return next_cell++;
}

Waitable*& bucket_of(const void* address) {
  WAITPOINT_FAST_CHECK(std::has_single_bit(bucket_count), "the number of buckets is no power of two");
  return buckets[Digest::mix(reinterpret_cast<std::uintptr_t>(address)) & (bucket_count - 1)];
}

void grow() {
  Waitable** const old = buckets;
  const std::size_t old_count = bucket_count;
  bucket_count = old_count == 0 ? 1024 : 2 * old_count;
  buckets = static_cast<Waitable**>(pages(bucket_count * sizeof(void*)));
  std::size_t moved = 0;
  for (std::size_t i = 0; i < old_count; ++i)
    for (Waitable *w = old[i], *next = nullptr; w != nullptr; w = next) {
      next = w->next_of_bucket;
      Waitable*& bucket = bucket_of(w->address);
      w->next_of_bucket = bucket;
      bucket = w;
      ++moved;
    }
  WAITPOINT_CHECK(moved == kept && kept < bucket_count, "the table of primitives and its count disagree");
  if (old != nullptr) madvise(old, old_count * sizeof(void*), MADV_DONTNEED);
}

void unlink(Waitable& waitable) {
  Waitable** link = &bucket_of(waitable.address);
  while (*link != nullptr && *link != &waitable) link = &(*link)->next_of_bucket;
  if (*link == nullptr) return;
  WAITPOINT_CHECK(kept > 0, "a primitive is removed from an empty table");
  *link = waitable.next_of_bucket;
  --kept;
}

}  // namespace

void reserve_waitables() {
  static constinit bool has_tried = false;
  if (has_tried) return;
  has_tried = true;
  void* const at = reinterpret_cast<void*>(first_pages);
  void* const memory =
      mmap(at, reserved_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == at)
    reserved_end = first_pages + reserved_bytes;
  else if (memory != MAP_FAILED)
    munmap(memory, reserved_bytes);
}

ReservedAddresses reserved_for_waitables() { return {first_pages, reserved_end}; }

bool names_waitables = false;

void label(Waitable& waitable) {
  if (const char* const name = symbol_at(waitable.address); name != nullptr) waitable.object.label = name;
}

Waitable* find_waitable(const void* address, Waitable::Kind kind) {
  if (bucket_count == 0) return nullptr;
  for (Waitable* w = bucket_of(address); w != nullptr; w = w->next_of_bucket)
    if (w->address == address) return w->kind == kind ? w : nullptr;
  return nullptr;
}

void* fresh_cell(const void* address) {
  if (kept >= bucket_count) grow();
  Waitable* found = bucket_of(address);
  while (found != nullptr && found->address != address) found = found->next_of_bucket;
  if (found != nullptr && found->idle()) return found;
  // A primitive there is still held or waited for: it remains, but is not found any more.
  if (found != nullptr) unlink(*found);
  const std::uintptr_t page = reinterpret_cast<std::uintptr_t>(address) / page_bytes;
  word_of_page(page) |= std::uint64_t{1} << page % 64;
  Waitable*& bucket = bucket_of(address);
  auto* made = new (take_cell()) Waitable(Waitable::Kind::word, "", address);
  made->next_of_bucket = bucket;
  bucket = made;
  ++kept;
  return made;
}

void forget(Waitable& waitable) {
  unlink(waitable);
  if (!waitable.idle()) return;
  Cell* const cell = reinterpret_cast<Cell*>(&waitable);
  WAITPOINT_CHECK(cell != first_free, "the cell of a primitive is freed twice");
  cell->next_free = first_free;
  first_free = cell;
}

Waitable* mark_freed(const void* memory, std::size_t bytes) {
  Waitable* awaited = nullptr;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory), end = begin + bytes;
  for (std::uintptr_t page = begin / page_bytes; kept > 0 && page * page_bytes < end; ++page) {
    if ((word_of_page(page) >> page % 64 & 1) == 0) continue;
    const std::uintptr_t last = std::min(end, (page + 1) * page_bytes);
    for (std::uintptr_t at = std::max(begin, page * page_bytes); at < last; at += alignof(void*))
      for (Waitable* w = bucket_of(reinterpret_cast<void*>(at)); w != nullptr; w = w->next_of_bucket) {
        if (reinterpret_cast<std::uintptr_t>(w->address) != at || w->kind == Waitable::Kind::word) continue;
        w->is_freed = true;
        if (w->object.first_waiter != nullptr) awaited = w;
      }
  }
  return awaited;
}

void add_waitable(BoundedText& text, const Waitable& waitable) {
  if (const char* const name = symbol_at(waitable.address); name != nullptr)
    text.add("%s %s", waitable.object.kind, name);
  else
    text.add("%s at %p", waitable.object.kind, waitable.address);
}

const Waitable* waitable_of(const kernel::Object& object) {
  for (std::size_t i = 0; i < bucket_count; ++i)
    for (const Waitable* w = buckets[i]; w != nullptr; w = w->next_of_bucket)
      if (&w->object == &object) return w;
  return nullptr;
}

}  // namespace waitpoint::posix
