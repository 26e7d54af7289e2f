// SPDX-License-Identifier: BSD-3-Clause
// What is remembered of memory: for each aligned word of 8 bytes that a task touched in this run, a cell with the
// recent accesses that a later one may race with.
//
//   page of addresses (4 KiB)        cells, in the order of first touch
//   +----------------------+         +--------------------------------+
//   | index of each word's |-------->| word, who touched it, accesses
//   | cell                 |         | ...
//   +----------------------+         +--------------------------------+
//
// An index counts only if it is of a cell in use that names the word (Briggs and Torczon's sparse sets): so a run
// begins by forgetting how many cells were in use, whatever it touched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "fibers/explore/races/hash_table.hpp"
#include "fibers/explore/races/vector_clock.hpp"
#include "fibers/kernel/access.hpp"

namespace waitpoint::races {

/// How memory is accessed; a set.
namespace kind {
inline constexpr std::uint8_t read = 0, write = 1, atomic = 2;
}

/// One access, as far as it touches one word.
struct MemoryAccess {
  std::uint64_t place;  ///< the address after the call that told of it
  Epoch epoch;
  std::uint32_t calls;  ///< its call path
  std::uint32_t event;  ///< the last event of its task before it
  std::uint16_t task;   ///< index into vector clocks
  std::uint8_t bytes;   ///< of the word, one bit each; 0: no access
  std::uint8_t kind : 2;
  std::uint8_t size : 6;  ///< in bytes, of the whole access; 63 is "or more"

  bool writes() const { return (kind & kind::write) != 0; }
  bool is_atomic() const { return (kind & kind::atomic) != 0; }
  /// Whether an access that races with `other` races with this one too, if both are known to who accesses.
  bool stands_for(const MemoryAccess& other) const { return covers(bytes, kind, other.bytes, other.kind); }
  /// The same of one of `bytes` and `kind` for another.
  static constexpr bool covers(unsigned bytes, unsigned kind, unsigned other_bytes, unsigned other_kind) {
    return (other_bytes & ~bytes) == 0 && (other_kind & ~kind & kind::write) == 0 &&
           (kind & ~other_kind & kind::atomic) == 0;
  }
  bool conflicts_with(const MemoryAccess& other) const {
    return (bytes & other.bytes) != 0 && (writes() || other.writes()) && !(is_atomic() && other.is_atomic());
  }
};
static_assert(sizeof(MemoryAccess) == 24);

inline constexpr int more_max = 3;

struct Cell {
  std::uint64_t word;      ///< address / 8; 0: forgotten
  kernel::Object* object;  ///< what the kernel knows it as; null before its first switch point
  std::uint32_t more;      ///< index of the accesses beside `latest`, or no_more
  std::uint16_t owner;     ///< the task that touched it first
  bool touched;
  bool several;  ///< touched by others too
  bool written;  ///< while several touch it, or as an atomic, or in a race: its order may matter
  MemoryAccess latest;
};

struct MoreAccesses {
  MemoryAccess access[more_max];
};

inline constexpr std::uint32_t no_more = ~std::uint32_t{0};

class Shadow {
 public:
  /// The index of the word's cell, an untouched one if it has none.
  std::uint32_t cell_of(std::uint64_t word) {
    Page& page = page_of(word / words_per_page);
    std::uint32_t& index = page.cells[word % words_per_page];
    if (page.run == run_ && index < cells_.size() && cells_[index].word == word) return index;
    page.run = run_;
    index = cells_.add();
    cells_[index] = Cell{word, nullptr, no_more, 0, false, false, false, {}};
    return index;
  }
  Cell& operator[](std::uint32_t index) { return cells_[index]; }
  /// What the cell is to the kernel, in this run.
  kernel::Object& object(Cell& cell) {
    if (cell.object == nullptr)
      cell.object = new (objects_.take(sizeof(kernel::Object))) kernel::Object(kernel::memory_kind);
    return *cell.object;
  }
  /// The accesses beside the cell's latest.
  MoreAccesses& more(Cell& cell) {
    if (cell.more == no_more) more_[cell.more = more_.add()] = MoreAccesses{};
    return more_[cell.more];
  }
  /// Nothing is known of this memory any more: others will use it.
  void forget(const void* low, std::size_t size);
  /// Nothing is known of any memory.
  void reset() {
    ++run_;
    cells_.reset();
    more_.reset();
    objects_.reset();
  }

 private:
  static constexpr std::uint64_t words_per_page = 512;
  struct Page {
    std::uint64_t run;  // in which it was last touched
    std::uint32_t cells[words_per_page];
  };

  Page& page_of(std::uint64_t number) {
    if (number == recent_number_) return *recent_;
    Page*& page = pages_[number];
    if (page == nullptr) page = static_cast<Page*>(page_memory_.take(sizeof(Page)));
    recent_number_ = number;
    return *(recent_ = page);
  }

  HashTable<Page*> pages_;
  Arena page_memory_;  // never reset: pages stay for later runs
  std::uint64_t recent_number_ = 0;
  Page* recent_ = nullptr;
  Table<Cell> cells_;
  Table<MoreAccesses> more_;
  Arena objects_;
  std::uint64_t run_ = 1;
};

}  // namespace waitpoint::races
