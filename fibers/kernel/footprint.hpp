// SPDX-License-Identifier: BSD-3-Clause
// The places of a run's state that events have in common, beside the objects at which they are: what an event reads and
// changes is a set of them, its footprint. Events of which none changes what the other reads or changes may be executed
// in either order.
//
// Kinds of state have a place each. Files share the remaining ones by the hash of their names: two names at one place
// make more events dependent than are, never fewer.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

/// A set of places.
using Places = std::uint64_t;

namespace place {
inline constexpr Places run = 1;  ///< read by every event
/// Two sides of a channel are two objects, polls look at several.
inline constexpr Places channels = 1 << 1;
inline constexpr Places timers = 1 << 2;      ///< a tick acts on all timers that it drives
inline constexpr Places processors = 1 << 3;  ///< turns of the tasks on a shared processor
inline constexpr Places locks = 1 << 4;   ///< a wait for a condition releases its lock, which the kernel does not see
inline constexpr Places memory = 1 << 5;  ///< weak memory, which fences order
inline constexpr Places descriptors = 1 << 6;    ///< the table of numbers
inline constexpr Places environment = 1 << 7;    ///< variables
inline constexpr Places directory = 1 << 8;      ///< the working directory
inline constexpr Places creation_mask = 1 << 9;  ///< umask
inline constexpr Places signals = 1 << 10;       ///< actions and masks
inline constexpr Places random = 1 << 11;        ///< the state of random numbers
inline constexpr Places threads = 1 << 12;       ///< names and attributes of threads, keys of their variables
inline constexpr Places process = 1 << 13;       ///< ids, limits, priorities, handlers of its end
inline constexpr Places file_locks = 1 << 14;
inline constexpr Places library = 1 << 15;  ///< state that the C library keeps between calls, as strtok() does
inline constexpr Places objects = 1 << 16;  ///< names of semaphores and of System V's objects
inline constexpr int first_file = 20, count = 64;
inline constexpr Places files = ~((Places{1} << first_file) - 1);
inline constexpr Places all = ~Places{0};
/// The place of the file with this hash of its name.
constexpr Places file(std::uint64_t hash) { return Places{1} << (first_file + hash % (count - first_file)); }
}  // namespace place

/// What an event reads and changes beside its object.
struct EventFootprint {
  Places reads = 0, changes = 0;

  friend constexpr bool operator==(const EventFootprint&, const EventFootprint&) = default;
  friend constexpr EventFootprint operator|(const EventFootprint& a, const EventFootprint& b) {
    return {a.reads | b.reads, a.changes | b.changes};
  }
};
constexpr EventFootprint reading(Places places) { return {.reads = places}; }
constexpr EventFootprint changing(Places places) { return {.changes = places}; }

}  // namespace waitpoint::kernel
