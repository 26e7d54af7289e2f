// SPDX-License-Identifier: BSD-3-Clause
// C++20's memory model for atomics, operationally: the recent stores to each location, and which of them a load may
// read.
//
//   location x      oldest                      newest
//   +-----------+---------+---------+---------+---------+
//   | kept      | store 0 | store 1 | store 2 | store 3 |   modification order = order of execution
//   +-----------+---------+---------+---------+---------+
//                          known <-- readable ---------->
//
// A load may read the newest store, and each older one down to the first whose successors it must not miss. Store W
// hides all older ones from a load L if an access to it, A (W itself, or a load that has read W):
//
//   1. happens before L (coherence);
//   2. is seq_cst, as L is;
//   3. happens before a seq_cst fence, and L is seq_cst;
//   4. is seq_cst, and precedes a seq_cst fence that happens before L;
//   5. happens before a seq_cst fence that precedes, in S, a seq_cst fence that happens before L.
//
// 2 to 5 are [atomics.order] paragraph 4 of C++20 with the order of execution of seq_cst operations as S. So every
// execution is one that the standard allows; the others, whose modification orders, S or reads (of later stores) go
// against every order of execution, are left out. A store's clock is that of its release sequence. The method is that
// of tsan11 (Lidbury, Donaldson, "Dynamic race detection for C++11", POPL 2017) and C11Tester (Luo, Demsky, ASPLOS
// 2021).
//
// Beyond C++, a barrier of the system (membarrier()) makes all stores before it hide older ones from all loads after
// it.
//
// Happens-before is the detector's. Memory itself holds the newest value: of plain accesses, and of code that is not
// instrumented. Where such code has written, the value in memory is the only one.
#pragma once

#include <cstdint>

#include "fibers/explore/races/arena.hpp"
#include "fibers/explore/races/shadow.hpp"
#include "fibers/explore/races/vector_clock.hpp"

namespace waitpoint::races {

/// The stores kept for each location. Older ones are never read.
inline constexpr std::uint32_t stores_kept = 8;
/// The number of times in succession that a task reads an older store; then it reads the newest, so that loops end.
inline constexpr std::uint32_t repeats_max = 4;

struct Store {
  std::uint64_t value;
  VectorClock released;    ///< acquired by those who read it
  VectorClock seen;        ///< by task: its epoch at its first access to the store, the making included; 0: none
  std::uint32_t strong;    ///< one more than the number of seq_cst fences before its first seq_cst access; 0: none
  std::uint32_t barriers;  ///< number of barriers before it
  std::uint32_t record;    ///< the record of the task that made it
  std::uint64_t place;     ///< the code; 0: the value in memory before the first atomic access
};

/// A naturally aligned range of at most 8 bytes that is accessed atomically as a whole.
struct Location {
  std::uint64_t address;
  std::uint32_t size;
  std::uint32_t next;       ///< index of the next location in the same word; none
  std::uint32_t made;       ///< number of stores so far; number n is at n % stores_kept
  bool is_overwritten;      ///< by plain code: the value in memory is the only one
  VectorClock last, times;  ///< by task: the number of the store read last, plus one; how often in succession
  Store stores[stores_kept];

  std::uint32_t kept() const { return made < stores_kept ? made : stores_kept; }
  /// The store with `newer` newer ones.
  Store& newest(std::uint32_t newer = 0) { return stores[(made - 1 - newer) % stores_kept]; }
};

/// A task at an operation.
struct Operator {
  VectorClock& clock;   ///< the events that happen before it
  std::uint32_t index;  ///< into clocks
  std::uint32_t record;
  std::uint64_t place;
  int order;

  Epoch epoch() const { return clock.epochs[index]; }
};

class WeakMemory {
 public:
  void begin_run();

  /// The location of an access, whose value in memory, before it, is `value`. `synchronised`: the clock of what other
  /// code has released there; null: none. Valid until the next call.
  Location& location(Cell& cell, std::uint64_t address, std::uint32_t size, std::uint64_t value,
                     const VectorClock* synchronised);
  /// Null if no access has made it. Valid as long.
  Location* find(const Cell& cell, std::uint64_t address, std::uint32_t size);
  /// Plain code is about to write these bytes of the cell's word.
  void overwrite(const Cell& cell, std::uint32_t bytes);

  /// The number of stores that a load may read, from the newest on.
  std::uint32_t readable(Location& location, const Operator& reader);
  /// It reads the store with `newer` newer ones.
  const Store& read(Location& location, std::uint32_t newer, const Operator& reader);
  /// A new store, with an empty clock.
  Store& store(Location& location, std::uint64_t value, const Operator& writer);
  /// Whoever reads the store knows what has this clock, too.
  void release(Store& store, const VectorClock& clock) { join(store.released, clock, clocks_); }
  void fence(const Operator& fencing);
  /// All stores made so far hide older ones from all later loads.
  void barrier() { ++barriers_; }

  /// True if a load was not offered a store that it may have read, by the two limits.
  bool left_out() const { return left_out_; }
  void forget_left_out() { left_out_ = false; }

 private:
  // A seq_cst fence.
  struct Fence {
    std::uint32_t index;  // of its task
    Epoch epoch;
    VectorClock before;  // the events that happen before the earlier fences
  };

  void restart(Location& location, std::uint64_t value, const VectorClock* synchronised);
  const Fence* last_fence_before(const VectorClock& clock, std::uint32_t& number);
  void note_access(Store& store, const Operator& by);

  Arena clocks_;
  Table<Location> locations_;
  Table<Fence> fences_;
  VectorClock fenced_;  // the events that happen before some fence
  std::uint32_t barriers_ = 0;
  bool left_out_ = false;
};

}  // namespace waitpoint::races
