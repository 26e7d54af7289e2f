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
  Context* next_free;
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
  void acquire(const void* at);
  /// An atomic operation at `at` with that order, as it takes effect.
  void atomic_load(const void* at, int order);
  void atomic_store(const void* at, int order);
  void atomic_modify(const void* at, int order);
  void fence(int order);

  // --- accesses ---

  bool watching() const { return watching_; }
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
  void update_watching();
  bool is_switch_point(const Cell& cell, std::uint8_t kind, std::uint64_t place);
  void pass_switch_point(kernel::Operation operation, Cell& cell);
  void learn_from(Cell& cell, std::uint64_t place);
  void learn_place(std::uint64_t place);
  void record(std::uint32_t cell, std::uint8_t bytes, std::uint8_t size, std::uint8_t kind, std::uint64_t place);
  void report(const Cell& cell, const MemoryAccess& first, const MemoryAccess& second);
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
  Context* outside_ = nullptr;
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
