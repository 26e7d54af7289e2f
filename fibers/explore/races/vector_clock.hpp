// SPDX-License-Identifier: BSD-3-Clause
// Vector clocks: what of every task's past a task, or a synchronisation point, knows of. What is beyond a clock's size
// it knows nothing of. (Flanagan and Freund, FastTrack, PLDI 2009.)
#pragma once

#include <cstdint>
#include <cstring>

#include "fibers/explore/races/arena.hpp"

namespace waitpoint::races {

using Epoch = std::uint32_t;  ///< of one task: grows whenever others may learn of what it did so far

struct VectorClock {
  Epoch* epochs = nullptr;
  std::uint32_t size = 0;
  std::uint32_t room = 0;

  Epoch of(std::uint32_t task) const { return task < size ? epochs[task] : 0; }
};

inline void extend(VectorClock& clock, std::uint32_t size, Arena& arena) {
  if (size <= clock.size) return;
  if (size > clock.room) {
    const std::uint32_t room = size < 8 ? 8 : 2 * size;
    Epoch* epochs = static_cast<Epoch*>(arena.take(room * sizeof(Epoch)));
    if (clock.size != 0) std::memcpy(epochs, clock.epochs, clock.size * sizeof(Epoch));
    clock.epochs = epochs;
    clock.room = room;
  }
  std::memset(clock.epochs + clock.size, 0, (size - clock.size) * sizeof(Epoch));
  clock.size = size;
}

/// `clock` knows what `other` knows, too.
inline void join(VectorClock& clock, const VectorClock& other, Arena& arena) {
  extend(clock, other.size, arena);
  for (std::uint32_t i = 0; i < other.size; ++i) {  // without a branch: which is greater cannot be foretold
    const Epoch own = clock.epochs[i], others = other.epochs[i];
    clock.epochs[i] = others > own ? others : own;
  }
}

/// `clock` knows what `other` knows, and nothing else.
inline void assign(VectorClock& clock, const VectorClock& other, Arena& arena) {
  clock.size = 0;
  extend(clock, other.size, arena);
  if (other.size != 0) std::memcpy(clock.epochs, other.epochs, other.size * sizeof(Epoch));
}

}  // namespace waitpoint::races
