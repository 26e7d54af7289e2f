// SPDX-License-Identifier: BSD-3-Clause
// Detects data races by happens-before (Flanagan and Freund, FastTrack, PLDI 2009), and makes memory accesses switch
// points.
//
// Two accesses to the same memory race if one writes, they are not both atomic, and neither happens before the other.
// Happens-before edges come from the kernel (see switch/sanitizer.hpp: creation of tasks, uses of objects), and from
// atomics by their memory order. Each task has a vector clock; an access is identified by its task and that one's
// epoch.
//
// An access is a switch point if its order may be observable: to a word that another task has accessed in this run,
// unless all of them only read; and to such a word at its first access, if the same code accessed shared memory in an
// earlier run while the detector learned. A first access cannot be told from a private one: without learning, schedules
// that interleave between a task's first access and its previous switch point are not tried.
//
// All fibers run in one OS thread: no locks are needed. Outside tasks, and in tasks that are unwound, accesses are
// ignored.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/call_paths.hpp"
#include "fibers/explore/races/runtime.hpp"
#include "fibers/explore/races/shadow.hpp"
#include "fibers/explore/races/vector_clock.hpp"
#include "fibers/explore/races/weak_memory.hpp"

namespace waitpoint::races {

/// The weight of an access that may poll for another task's write, relative to a plain one.
inline constexpr std::uint32_t atomic_weight = 100;
/// Private accesses are no switch points. A task that polls such memory for another's write would never yield: after
/// accesses of this total weight the other tasks get a turn.
inline constexpr std::uint32_t weight_max = 100'000;

/// The detector's record of a task, or of the code outside all tasks.
struct Context {
  VectorClock clock;       ///< the events that happen before its next one
  VectorClock released;    ///< the clock at its last release fence
  VectorClock acquirable;  ///< acquired by its relaxed loads, pending its next acquire fence
  Epoch accessed;          ///< its epoch at its last recorded access
  std::uint16_t index;     ///< index into clocks
  bool is_task;
  std::uint32_t ignoring;  ///< open calls of ignore_begin
  std::uint32_t record;    ///< index of its record for reports
  Context* next;           ///< list of the contexts in use, or of the free ones
  Context* previous;
  std::uint64_t outside_known;  ///< the value of outside_left_ when it last acquired the outside's clock
  CallStack calls;

  Epoch epoch() const { return clock.epochs[index]; }
};

class Detector {
 public:
  /// The program's only one: the compiler's calls have no context argument.
  static Detector& the();

  // --- runs and tasks ---

  /// Resets everything except learned code. Not from within a task.
  void begin_run();
  bool has_current() const { return current_ != nullptr; }
  Context& current() { return *current_; }
  /// A task created by the current one.
  Context& make();
  void name(Context& context, const char* name);
  void switch_to(Context& context);
  void end(Context& context);
  /// From now on, over runs too, code outside of tasks is not the program's, and orders events only when it says so.
  void set_outside_apart() { outside_is_apart_ = true; }
  /// Not from within a task: all past events happen before all later ones.
  void order_by_outside();

  // --- happens-before ---

  void release(const void* at);
  /// acquire(), then release().
  void use(const void* at);
  void acquire(const void* at);
  /// An atomic operation at `at` with that order, at the moment of its effect.
  void atomic_load(const void* at, int order);
  void atomic_store(const void* at, int order);
  void atomic_modify(const void* at, int order);
  void fence(int order);

  // --- weak memory ---

  /// Whether later runs have it.
  void set_weak(bool on) { is_weak_ = on; }
  bool is_weak() const { return is_weak_; }
  /// An atomic operation of at most 8 bytes at their natural alignment, in place of the above. `found` is the value in
  /// memory before it. A load returns the value to use: the newest, or an older one by choice.
  std::uint64_t weak_load(std::uint64_t address, std::uint32_t size, std::uint64_t found, int order, const void* place);
  void weak_store(std::uint64_t address, std::uint32_t size, std::uint64_t found, std::uint64_t value, int order,
                  const void* place);
  void weak_modify(std::uint64_t address, std::uint32_t size, std::uint64_t found, std::uint64_t value, int order,
                   const void* place);
  /// A compare-and-exchange that has failed: reads the newest value.
  void weak_compare(std::uint64_t address, std::uint32_t size, std::uint64_t found, int order, const void* place);
  /// Code that is not instrumented has read the value in memory, without an order.
  void weak_read(const void* word, std::size_t size);
  /// All stores made so far hide older ones from all loads.
  void weak_barrier() { weak_.barrier(); }
  /// Another atomic operation has written: the value in memory is the only one.
  void weak_overwrite(std::uint64_t address, std::uint32_t size);
  /// During a choice of the value of a load: the store with `newer` newer ones.
  ReadableStore readable_store(std::uint32_t newer);
  bool left_out_values() const { return weak_.left_out(); }
  void forget_left_out_values() { weak_.forget_left_out(); }

  // --- accesses ---

  bool watching() const { return watching_; }
  /// An access within one aligned word. Most are plain ones to words that no other task has accessed, and cannot race.
  [[gnu::always_inline]] void access_word(std::uint64_t address, std::uint32_t size, std::uint8_t kind,
                                          const void* place, kernel::Operation operation) {
    Cell* const cell = shadow_.find(address / 8);
    const Seen seen{.place = reinterpret_cast<std::uint64_t>(place),
                    .footprint = footprint_of(address, size, kind),
                    .size = static_cast<std::uint8_t>(size),
                    .operation = operation};
    if (cell == nullptr) return touch(address / 8, seen);
    if (cell->owner != current_->index || !cell->is_private || (kind & kind::atomic) != 0 ||
        weight_ + 1 >= weight_max || is_learned(seen.place))
      return access_shared(*cell, seen);
    ++weight_;
    if (cell->latest.epoch != current_->epoch() || !footprint::covers(cell->latest.footprint, seen.footprint))
      record_own(*cell, seen);
  }
  void access_range(std::uint64_t address, std::size_t size, std::uint8_t kind, const void* place,
                    kernel::Operation operation);
  /// Replaces an access while none are watched.
  void unwatched(std::uint32_t weight);
  void ignore(bool begin);
  /// The memory gets a new owner.
  void forget(const void* low, std::size_t size) { shadow_.forget(low, size); }

  // --- results ---

  std::size_t found(const FoundRace*& races) const;
  void learn(bool on) { learning_ = on; }
  /// Whether later runs note that code which is not learned accesses shared memory; begins with nothing noted.
  void note_unlearned(bool on) {
    noting_ = on;
    unlearned_ = false;
  }
  bool noted_unlearned() const { return unlearned_; }
  void forget_learned();
  void know(std::uint64_t place);
  void tell(const Listener& listener) { listener_ = &listener; }

 private:
  struct TaskRecord {
    char name[kernel::name_size];
    std::uint16_t index;
    Epoch first;  // of this task: earlier ones belong to a former task with its index
  };
  struct FreeIndex {
    std::uint16_t index;
    Epoch last, accessed;
  };
  struct SyncPoint {
    VectorClock clock;
    std::uint64_t run;
  };

  /// An access to a word; passed in registers.
  struct Seen {
    std::uint64_t place;
    Footprint footprint;
    std::uint8_t size;
    kernel::Operation operation;

    bool writes() const { return (footprint & footprint::write) != 0; }
    bool is_atomic() const { return (footprint & footprint::plain) == 0; }
  };

  VectorClock& sync_point(const void* at);
  Location& location_of(std::uint64_t address, std::uint32_t size, std::uint64_t found);
  void acquire_from(const Store& store, int order);
  Context& fresh_context();
  void take_index(Context& context, const Context& maker);
  // Later events of the task are unknown to those that acquired its earlier releases.
  static void next_epoch(Context& context) { ++context.clock.epochs[context.index]; }
  void leave_outside();
  void enter_outside();
  void update_watching();
  [[gnu::noinline]] void touch(std::uint64_t word, Seen seen);
  [[gnu::noinline]] void access_shared(Cell& cell, Seen seen);
  [[gnu::noinline]] void record_own(Cell& cell, Seen seen);
  bool is_learned(std::uint64_t place) {
    const std::uint64_t bit = bit_of(place);
    return __builtin_expect((learned_bits_[bit / 64] >> bit % 64 & 1) != 0, 0) && learned_.find(place) != nullptr;
  }
  static std::uint64_t bit_of(std::uint64_t place) { return place * 0x9E3779B97F4A7C15u >> (64 - 12); }
  bool is_shared_switch_point(const Cell& cell, bool writes) const;
  bool is_other_switch_point(const Seen& seen);
  void pass_switch_point(const Seen& seen, Cell& cell);
  void learn_from(Cell& cell, std::uint64_t place);
  void learn_place(std::uint64_t place);
  void begin_cell(Cell& cell, const Seen& seen);
  void record(Cell& cell, const Seen& seen);
  static Footprint footprint_of(std::uint64_t address, std::uint64_t size, std::uint8_t kind) {
    return footprint::of(((1u << size) - 1) << (address % 8), kind);
  }
  [[gnu::always_inline]] MemoryAccess describe(const Seen& seen) {
    Context& self = *current_;
    return {.place = seen.place,
            .epoch = self.epoch(),
            .calls = self.calls.path(paths_),
            .event = static_cast<std::uint32_t>(kernel::running->sequence),
            .task = self.index,
            .footprint = static_cast<Footprint>(seen.footprint & 0x3FF),
            .size = static_cast<Footprint>(seen.size & 63)};
  }
  void keep_own(Cell& cell, Footprint footprint, unsigned kept);
  [[gnu::noinline]] void keep(Cell& cell, unsigned kept);
  [[gnu::noinline]] void report(Cell& cell, const MemoryAccess& first, const MemoryAccess& second);
  void describe(Side& side, const MemoryAccess& access);

  Shadow shadow_;
  WeakMemory weak_;
  Location* read_location_ = nullptr;  // of the last choice of a value
  int read_order_ = 0;
  CallPaths paths_;
  Arena clocks_;
  HashTable<SyncPoint> sync_points_;
  const void* recent_sync_at_ = nullptr;
  VectorClock* recent_sync_point_ = nullptr;
  HashTable<bool> learned_;  // by address of the code
  // A bit filter over them: most code is excluded by it.
  std::uint64_t learned_bits_[64] = {};
  Table<TaskRecord> tasks_;
  Table<FreeIndex> free_indices_;
  Arena contexts_;  // never reset
  Context* free_contexts_ = nullptr;
  Context* contexts_in_use_ = nullptr;  // the tasks'
  Context* outside_ = nullptr;
  VectorClock ended_;               // the clocks of ended tasks, for the code outside to acquire
  std::uint64_t outside_left_ = 0;  // counts the ends of code outside
  bool outside_is_apart_ = false;
  Context* current_ = nullptr;
  std::uint64_t run_ = 0;
  std::uint32_t indices_ = 0;
  std::uint32_t weight_ = 0;  // of the accesses since the last switch point
  bool watching_ = false;
  bool is_weak_ = false;
  bool learning_ = false;
  bool noting_ = false, unlearned_ = false;
  const Listener* listener_ = nullptr;
  std::size_t race_count_ = 0;
  FoundRace races_[races_kept] = {};
};

/// Called by the compiler and the kernel; zero-initialised, so that it works before any constructor has run.
extern Detector detector;
inline Detector& Detector::the() { return detector; }

}  // namespace waitpoint::races
