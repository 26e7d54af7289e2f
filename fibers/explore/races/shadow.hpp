// SPDX-License-Identifier: BSD-3-Clause
// Shadow memory: for each aligned word of 8 bytes accessed by a task in this run, a cell with the recent accesses that
// later ones may race with.
//
//   page of addresses (16 KiB)       cells, in the order of first access
//   +----------------------+         +--------------------------------+
//   | index of each word's |-------->| word, its first task, accesses |
//   | cell                 |         | ...                            |
//   +----------------------+         +--------------------------------+
//
// An index is valid only if its cell is in use and names the word (Briggs and Torczon's sparse sets): so a run starts
// by resetting the number of cells in use, however many words were accessed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "fibers/explore/races/hash_table.hpp"
#include "fibers/explore/races/vector_clock.hpp"
#include "fibers/kernel/access.hpp"

namespace waitpoint::races {

/// The kind of an access; a set.
namespace kind {
inline constexpr std::uint8_t read = 0, write = 1, atomic = 2;
}

/// The bytes of a word that an access covers, one bit each, and two flags for conflicts: write, plain. An access whose
/// footprint contains an earlier one's replaces it, if both happen before the current access.
using Footprint = std::uint16_t;
namespace footprint {
inline constexpr Footprint bytes = 0xFF, write = 1 << 8, plain = 1 << 9;

constexpr Footprint of(std::uint32_t bytes_touched, std::uint8_t kind) {
  return static_cast<Footprint>(bytes_touched | ((kind & kind::write) != 0 ? write : 0) |
                                ((kind & kind::atomic) == 0 ? plain : 0));
}
constexpr bool covers(Footprint one, Footprint other) { return (other & ~one) == 0; }
/// True if two unordered accesses race.
constexpr bool conflict(Footprint one, Footprint other) {
  return (one & other & bytes) != 0 && ((one | other) & write) != 0 && ((one | other) & plain) != 0;
}
}  // namespace footprint

/// The part of an access within one word.
struct MemoryAccess {
  std::uint64_t place;  ///< return address of the runtime's call
  Epoch epoch;
  std::uint32_t calls;           ///< its call path
  std::uint32_t event;           ///< the last event of its task before the access
  std::uint16_t task;            ///< index into vector clocks
  std::uint16_t footprint : 10;  ///< a Footprint
  std::uint16_t size : 6;        ///< in bytes, of the whole access; 63 is "or more"

  std::uint32_t bytes() const { return footprint & footprint::bytes; }
  bool writes() const { return (footprint & footprint::write) != 0; }
  bool is_atomic() const { return (footprint & footprint::plain) == 0; }
};
static_assert(sizeof(MemoryAccess) == 24);

inline constexpr int more_max = 3;

struct alignas(64) Cell {
  std::uint64_t word;          ///< address / 8; 0: forgotten
  kernel::MemoryWord* object;  ///< the kernel's object for it; null before its first switch point
  std::uint32_t more;          ///< index of the accesses older than `latest`; no_more until needed
  std::uint32_t locations;     ///< in weak memory, index of the first atomic one; no_location until needed
  std::uint16_t owner;         ///< the task with the first access
  std::uint8_t more_count;
  bool touched;
  bool is_private;  ///< touched, by its owner alone, and without locations: plain accesses of the owner need no care
  bool several;     ///< accessed by other tasks, too
  bool written;     ///< written while shared, accessed atomically, or part of a race: its order may matter
  MemoryAccess latest;
};
static_assert(sizeof(Cell) == 64);

struct MoreAccesses {
  MemoryAccess access[more_max];
};

inline constexpr std::uint32_t no_more = ~std::uint32_t{0}, no_location = no_more;

class Shadow {
 public:
  /// The word's cell; null if it has none.
  [[gnu::always_inline]] Cell* find(std::uint64_t word) {
    const RecentPage& recent = recent_[place_of(word / words_per_page)];
    Page* page = recent.page;
    if (__builtin_expect(recent.key != word / words_per_page + 1, 0)) {
      page = seek_page(word / words_per_page);
      if (page == nullptr) return nullptr;
    }
    if (__builtin_expect(page->run != run_, 0)) return nullptr;
    const std::uint32_t index = page->cells[word % words_per_page];
    return __builtin_expect(index < cells_.size() && cells_[index].word == word, 1) ? &cells_[index] : nullptr;
  }
  /// A fresh cell for a word without one.
  Cell& new_cell(std::uint64_t word);
  /// The word's cell, a fresh one if it has none. Valid until the next call.
  Cell& cell_of(std::uint64_t word) {
    Cell* const cell = find(word);
    return __builtin_expect(cell != nullptr, 1) ? *cell : new_cell(word);
  }
  std::uint32_t index_of(const Cell& cell) { return static_cast<std::uint32_t>(&cell - &cells_[0]); }
  /// The word's cell, by a former index; another if it was forgotten since.
  Cell& cell_again(std::uint32_t index, std::uint64_t word) {
    return __builtin_expect(cells_[index].word == word, 1) ? cells_[index] : cell_of(word);
  }
  /// The kernel's object for the cell, in this run.
  kernel::MemoryWord& object(Cell& cell) {
    if (cell.object == nullptr)
      cell.object = new (objects_.take(sizeof(kernel::MemoryWord))) kernel::MemoryWord(cell.word * 8);
    return *cell.object;
  }
  /// The accesses older than the cell's latest, in reverse order: more_count of them.
  MemoryAccess* more(Cell& cell) {
    if (cell.more == no_more) cell.more = more_.add();
    return more_[cell.more].access;
  }
  /// Drops everything about this memory: it gets a new owner.
  void forget(const void* low, std::size_t size);
  /// Drops everything about all memory.
  void reset() {
    ++run_;
    cells_.reset();
    more_.reset();
    objects_.reset();
  }

 private:
  static constexpr std::uint64_t words_per_page = 2048;
  static constexpr std::uint64_t words_per_group = words_per_page / 64;
  struct Page {
    std::uint64_t run;     // of its last access
    std::uint64_t groups;  // a bit for each group of words with a cell in that run
    std::uint32_t cells[words_per_page];
  };

  // A cache of the table's entries for a few pages.
  static constexpr std::uint64_t recent_pages = 16;
  static std::uint64_t place_of(std::uint64_t number) { return number * 0x9E3779B97F4A7C15u >> 60; }
  struct RecentPage {
    std::uint64_t key;  // page number plus one; 0: none
    Page* page;
  };

  void forget(const Page& page, std::uint64_t begin, std::uint64_t from, std::uint64_t to);
  [[gnu::noinline]] Page* seek_page(std::uint64_t number);

  RecentPage recent_[recent_pages] = {};
  HashTable<Page*> pages_;
  Arena page_memory_;  // never reset: pages stay for later runs
  Table<Cell> cells_;
  Table<MoreAccesses> more_;
  Arena objects_;
  std::uint64_t run_ = 1;
};

}  // namespace waitpoint::races
