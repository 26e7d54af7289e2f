// SPDX-License-Identifier: BSD-3-Clause
// Data races by happens-before (Flanagan and Freund, FastTrack, PLDI 2009), and memory accesses as switch points.
//
// Two accesses to the same memory race if one writes, they are not both atomic, and nothing orders them. What orders is
// told by the kernel (see switch/sanitizer.hpp: making a task, each use of an object), and by atomics to their
// memory order. Each task has a vector clock; an access is known by its task and that one's epoch.
//
// An access is a switch point where others can tell when it happens: to a word that another task has touched in this
// run, unless all of them only read; and where such a word was accessed by the same code in an earlier run of which the
// detector was to learn. First touches alone cannot be told from private ones: without learning, what comes between a
// task's first touch and its switch point before that is not tried.
//
// All fibers run in one thread of the system: nothing here locks. Outside tasks, and in tasks that are unwound,
// accesses count for nothing.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/call_paths.hpp"
#include "fibers/explore/races/runtime.hpp"
#include "fibers/explore/races/shadow.hpp"
#include "fibers/explore/races/vector_clock.hpp"

namespace waitpoint::races {

/// Of an access by which a task may wait for another's, against a plain one.
inline constexpr std::uint32_t atomic_weight = 100;
/// Who accesses only what nobody else touches passes no switch point. One that waits so for another's write would wait
/// for ever: after accesses of so much weight the others get a turn.
inline constexpr std::uint32_t weight_max = 100'000;

/// A task as the detector sees it, or what runs outside all tasks.
struct Context {
  VectorClock clock;       ///< what happened before what it does now
  VectorClock released;    ///< what its last release fence gave
  VectorClock acquirable;  ///< what its relaxed loads saw: its next acquire fence takes it
  Epoch accessed;          ///< its epoch when it was last recorded
  std::uint16_t index;     ///< into clocks
  bool is_task;
  std::uint32_t ignoring;  ///< calls of ignore_begin that are open
  std::uint32_t record;    ///< index of what reports call it
  Context* next;           ///< of those that there are, or that are free
  Context* previous;
  std::uint64_t outside_known;  ///< how often the code outside had been left when it learned what that did
  CallStack calls;

  Epoch epoch() const { return clock.epochs[index]; }
};

class Detector {
 public:
  /// The one of this program: the compiler's calls name none.
  static Detector& the();

  // --- runs and tasks ---

  /// Forgets all, but what was learned. Not from within a task.
  void begin_run();
  bool has_current() const { return current_ != nullptr; }
  Context& current() { return *current_; }
  /// A task made by the current one.
  Context& make();
  void name(Context& context, const char* name);
  void switch_to(Context& context);
  void end(Context& context);

  // --- what happens before what ---

  void release(const void* at);
  /// acquire(), then release().
  void use(const void* at);
  void acquire(const void* at);
  /// An atomic operation at `at` with that order, as it takes effect.
  void atomic_load(const void* at, int order);
  void atomic_store(const void* at, int order);
  void atomic_modify(const void* at, int order);
  void fence(int order);

  // --- accesses ---

  bool watching() const { return watching_; }
  /// One within an aligned word. Most are plain ones to words that no other task has touched: nothing can race.
  [[gnu::always_inline]] void access_word(std::uint64_t address, std::uint32_t size, std::uint8_t kind,
                                          const void* place, kernel::Operation operation) {
    Cell* const cell = shadow_.find(address / 8);
    const Seen seen{.place = reinterpret_cast<std::uint64_t>(place),
                    .footprint = footprint_of(address, size, kind),
                    .size = static_cast<std::uint8_t>(size),
                    .operation = operation};
    if (cell == nullptr) return touch(address / 8, seen);
    if (cell->owner != current_->index || !cell->touched || cell->several || (kind & kind::atomic) != 0 ||
        weight_ + 1 >= weight_max || is_learned(seen.place))
      return access_shared(*cell, seen);
    ++weight_;
    if (cell->latest.epoch != current_->epoch() || !footprint::covers(cell->latest.footprint, seen.footprint))
      record_own(*cell, seen);
  }
  void access_range(std::uint64_t address, std::size_t size, std::uint8_t kind, const void* place,
                    kernel::Operation operation);
  /// In place of an access where nothing is watched.
  void unwatched(std::uint32_t weight);
  void ignore(bool begin);
  /// The memory is another's from now on.
  void forget(const void* low, std::size_t size) { shadow_.forget(low, size); }

  // --- what came of it ---

  std::size_t found(const FoundRace*& races) const;
  void learn(bool on) { learning_ = on; }
  void forget_learned();
  void know(std::uint64_t place);
  void tell(const Listener& listener) { listener_ = &listener; }

 private:
  struct TaskRecord {
    char name[kernel::name_size];
    std::uint16_t index;
    Epoch first;  // of this task: earlier ones are of another with its index
  };
  struct FreeIndex {
    std::uint16_t index;
    Epoch last, accessed;
  };
  struct SyncPoint {
    VectorClock clock;
    std::uint64_t run;
  };

  /// An access to a word as it comes; it goes through registers.
  struct Seen {
    std::uint64_t place;
    Footprint footprint;
    std::uint8_t size;
    kernel::Operation operation;

    bool writes() const { return (footprint & footprint::write) != 0; }
    bool is_atomic() const { return (footprint & footprint::plain) == 0; }
  };

  VectorClock& sync_point(const void* at);
  Context& fresh_context();
  void take_index(Context& context, const Context& maker);
  void next_epoch(Context& context);
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
  void pass_switch_point(kernel::Operation operation, Cell& cell);
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
  CallPaths paths_;
  Arena clocks_;
  HashTable<SyncPoint> sync_points_;
  const void* recent_sync_at_ = nullptr;
  VectorClock* recent_sync_point_ = nullptr;
  HashTable<bool> learned_;  // places of code
  // A bit for each of them, shared by some: of most code it tells that it is not among them.
  std::uint64_t learned_bits_[64] = {};
  Table<TaskRecord> tasks_;
  Table<FreeIndex> free_indices_;
  Arena contexts_;  // never reset
  Context* free_contexts_ = nullptr;
  Context* contexts_in_use_ = nullptr;  // the tasks'
  Context* outside_ = nullptr;
  VectorClock ended_;               // what tasks that ended knew, for the code outside to learn
  std::uint64_t outside_left_ = 0;  // how often that was left
  Context* current_ = nullptr;
  std::uint64_t run_ = 0;
  std::uint32_t indices_ = 0;
  std::uint32_t weight_ = 0;  // of the accesses since the last switch point
  bool watching_ = false;
  bool learning_ = false;
  const Listener* listener_ = nullptr;
  std::size_t race_count_ = 0;
  FoundRace races_[races_kept] = {};
};

/// For the compiler's and the kernel's calls; zero-initialised, so that they may come before any constructor.
extern Detector detector;
inline Detector& Detector::the() { return detector; }

}  // namespace waitpoint::races
