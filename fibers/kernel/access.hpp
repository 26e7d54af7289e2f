// SPDX-License-Identifier: BSD-3-Clause
// Accesses to memory as waitpoints: the interface for a runtime that intercepts them (fibers/explore/races).
//
// To the kernel a memory location is an object with a kind of its own, numbered at its first use in the run, so that no
// address enters an event. Unlike other objects it does not synchronise its users.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// Object::kind of memory, by address.
extern const char memory_kind[];

/// A word of eight bytes, in which accesses begin at the bytes of `starts`, one bit each.
struct MemoryWord : Object {
  explicit MemoryWord(std::uint64_t address_of) : Object(memory_kind), address(address_of) {}

  const std::uint64_t address;
  std::uint8_t starts = 0;
};

/// A waitpoint of the running task before `operation` on memory shared with others; `memory` is null for operations
/// without a location. Returns at once for a timer, which cannot wait, and when the run is over.
void access(Operation operation, Object* memory);
/// The store, counted from the newest, whose value a load of the running task returns, of `count`; the newest for a
/// timer, whose events have no choices of this kind.
std::uint32_t choose_value(std::uint32_t count);
/// Yields, after a long computation without a waitpoint. Returns at once for a timer and when the run is over.
void yield_after_computing();

}  // namespace waitpoint::kernel
