// SPDX-License-Identifier: BSD-3-Clause
// Dependent events, i.e. those whose order may change the result. There is one relation: pos and rff redraw, dpor
// reverses, and the trace hash tells apart what is dependent.
//
// A segment, as an event and what its task does up to the next one, has a footprint: what it reads and changes, its
// object and places that many objects have in common. Two are dependent if one of them changes what the other reads or
// changes.
#pragma once

#include <cstdint>

#include "fibers/explore/strategies/memory_option.hpp"
#include "fibers/explore/strategies/operations.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::exploration {

/// What an event is known by before it happens.
struct Action {
  kernel::Operation operation = kernel::Operation::start;
  std::uint64_t object = 0;             ///< identity; 0: none
  bool is_on_shared_processor = false;  ///< its turn delays the others', by an order that depends on their priorities
  kernel::EventFootprint declared;      ///< by who announces it: Task::footprint
};

using kernel::Places;
namespace place = kernel::place;

/// The pending event of a task; of a call, the object is only the function's name.
inline Action action_of(const kernel::Task& task) {
  const bool is_at_object = task.at != nullptr && task.operation != kernel::Operation::call;
  return {task.operation, is_at_object ? task.at->identity : 0, task.seat != nullptr, task.footprint};
}

/// What a segment reads and changes, as far as it is known.
struct SegmentFootprint {
  Places reads = 0, changes = 0;  ///< a place is in one of them at most
  bool has_object = false;
  bool changes_object = false;
  std::uint64_t object = 0;  ///< identity; 0: something unknown
};

inline bool are_dependent(const SegmentFootprint& a, const SegmentFootprint& b) {
  if ((a.changes & (b.reads | b.changes)) != 0 || (b.changes & a.reads) != 0) return true;
  return a.has_object && b.has_object && a.object == b.object && (a.changes_object || b.changes_object);
}

namespace operations {

using kernel::Operation;

inline constexpr Operations reads(Operation::load, Operation::stop_requested);
/// A yielding task is not offered until another has acted; a signal acts at the next event of another task; whatever
/// comes behind the end of the process does not happen.
inline constexpr Operations acts_on_run(Operation::yield, Operation::signal, Operation::exit);
inline constexpr Operations of_channels(Operation::open, Operation::close, Operation::connect, Operation::accept,
                                        Operation::send, Operation::receive, Operation::poll);
inline constexpr Operations of_timers(Operation::timer_start, Operation::timer_stop, Operation::timer_wait,
                                      Operation::timer_tick);
inline constexpr Operations of_locks(Operation::lock, Operation::try_lock, Operation::unlock, Operation::lock_shared,
                                     Operation::try_lock_shared, Operation::unlock_shared);
inline constexpr Operations of_memory(Operation::load, Operation::store, Operation::exchange,
                                      Operation::compare_exchange, Operation::modify);
/// Without an object, the others act on something that the kernel does not know as one: a descriptor, a file, a signal,
/// memory between processes.
inline constexpr Operations without_object(Operation::start, Operation::end, Operation::resume, Operation::timeout,
                                           Operation::yield, Operation::sleep, Operation::fence, Operation::call);

}  // namespace operations

/// True if it does not change its object.
inline bool is_read_only(kernel::Operation operation) { return operations::reads.contain(operation); }

/// Of an event before it happens. In weak memory loads of one location are dependent: a seq_cst one has its place in
/// the order of all.
inline SegmentFootprint footprint_of(const Action& action, Memory memory) {
  const kernel::Operation operation = action.operation;
  SegmentFootprint footprint{.reads = place::run, .object = action.object};
  if (operations::acts_on_run.contain(operation)) footprint = {.changes = place::run, .object = action.object};
  if (operations::of_channels.contain(operation)) {
    footprint.reads |= place::descriptors;
    footprint.changes |= place::channels;
  }
  if (operations::of_timers.contain(operation)) footprint.changes |= place::timers;
  if (action.is_on_shared_processor) footprint.changes |= place::processors;
  if (operations::of_locks.contain(operation)) footprint.reads |= place::locks;
  if (operation == kernel::Operation::wait) footprint.changes |= place::locks;
  const bool is_weak = memory == Memory::weak;
  if (is_weak && operations::of_memory.contain(operation)) footprint.reads |= place::memory;
  if (is_weak && operation == kernel::Operation::fence) footprint.changes |= place::memory;
  footprint.changes |= action.declared.changes;
  footprint.reads = (footprint.reads | action.declared.reads) & ~footprint.changes;
  footprint.has_object = action.object != 0 || !operations::without_object.contain(operation);
  const bool only_reads =
      action.object != 0 && is_read_only(operation) && !(is_weak && operations::of_memory.contain(operation));
  footprint.changes_object = footprint.has_object && !only_reads;
  return footprint;
}

inline bool are_dependent(const Action& a, const Action& b, Memory memory) {
  return are_dependent(footprint_of(a, memory), footprint_of(b, memory));
}

}  // namespace waitpoint::exploration
