// SPDX-License-Identifier: BSD-3-Clause
// Data races by happens-before (Flanagan and Freund, FastTrack, PLDI 2009), and memory accesses as switch points.
//
// Two accesses to the same memory race if one writes, they are not both atomic, and nothing orders them. What orders is
// told by the kernel (see kernel/sanitizer.hpp: making a task, each use of an object), and by atomics to their
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
  /// A plain one within an aligned word that no other task has touched, as most are: nothing can race. False, and
  /// nothing is done, if it is another, for access_word().
  [[gnu::always_inline]] bool access_own(std::uint64_t address, std::uint32_t size, std::uint8_t kind,
                                         const void* place) {
    Cell* const cell = shadow_.find(address / 8);
    const Footprint footprint = footprint_of(address, size, kind);
    if (cell == nullptr || cell->owner != current_->index || !cell->touched || cell->several) return false;
    const auto at = reinterpret_cast<std::uint64_t>(place);
    if (weight_ + 1 >= weight_max || learned_.find(at) != nullptr) return false;
    ++weight_;
    const Epoch epoch = current_->epoch();
    if (cell->latest.epoch == epoch && footprint::covers(cell->latest.footprint, footprint)) return true;
    current_->accessed = epoch;
    const unsigned kept = !footprint::covers(footprint, cell->latest.footprint);
    if (__builtin_expect((kept | cell->more_count) != 0, 0)) keep_own(*cell, footprint, kept);
    cell->latest = describe(footprint, size, at);
    return true;
  }
  /// One within an aligned word.
  void access_word(std::uint64_t address, std::uint32_t size, std::uint8_t kind, const void* place,
                   kernel::Operation operation);
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
  void forget_learned() { learned_.clear(); }
  void know(std::uint64_t place) { learned_[place] = true; }
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

  VectorClock& sync_point(const void* at);
  Context& fresh_context();
  void take_index(Context& context, const Context& maker);
  void next_epoch(Context& context);
  void leave_outside();
  void enter_outside();
  void update_watching();
  bool is_switch_point(const Cell& cell, std::uint8_t kind, std::uint64_t place);
  void pass_switch_point(kernel::Operation operation, Cell& cell);
  void learn_from(Cell& cell, std::uint64_t place);
  void learn_place(std::uint64_t place);
  void record(Cell& cell, Footprint footprint, std::uint32_t size, std::uint64_t place);
  static Footprint footprint_of(std::uint64_t address, std::uint64_t size, std::uint8_t kind) {
    return footprint::of(((1u << size) - 1) << (address % 8), kind);
  }
  [[gnu::always_inline]] MemoryAccess describe(Footprint footprint, std::uint32_t size, std::uint64_t place) {
    Context& self = *current_;
    return {.place = place,
            .epoch = self.epoch(),
            .calls = self.calls.path(paths_),
            .event = static_cast<std::uint32_t>(kernel::running->sequence),
            .task = self.index,
            .footprint = static_cast<Footprint>(footprint & 0x3FF),
            .size = static_cast<Footprint>(size & 63)};
  }
  [[gnu::noinline]] void keep_own(Cell& cell, Footprint footprint, unsigned kept);
  void keep(Cell& cell, unsigned kept);
  [[gnu::noinline]] void report(Cell& cell, const MemoryAccess& first, const MemoryAccess& second);
  void describe(Side& side, const MemoryAccess& access);

  Shadow shadow_;
  CallPaths paths_;
  Arena clocks_;
  HashTable<SyncPoint> sync_points_;
  const void* recent_sync_at_ = nullptr;
  VectorClock* recent_sync_point_ = nullptr;
  HashTable<bool> learned_;  // places of code
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
