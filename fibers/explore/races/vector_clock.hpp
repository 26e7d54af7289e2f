// SPDX-License-Identifier: BSD-3-Clause
// Vector clocks: for each task, the epoch up to which its past is known to a task or synchronisation point. Entries
// beyond a clock's size are 0. (Flanagan and Freund, FastTrack, PLDI 2009.)
#pragma once

#include <cstdint>
#include <cstring>

#include "fibers/explore/races/arena.hpp"

namespace waitpoint::races {

using Epoch = std::uint32_t;  ///< of one task: incremented at each release

struct VectorClock {
  Epoch* epochs = nullptr;
  std::uint32_t size = 0;
  std::uint32_t room = 0;

  Epoch of(std::uint32_t task) const { return task < size ? epochs[task] : 0; }
};

// Clocks have room for a multiple of `stride` epochs, and are zero-filled from their size to the next multiple, so that
// loops process a stride at a time.
inline constexpr std::uint32_t stride = 4;
using Stride [[gnu::vector_size(16), gnu::may_alias]] = Epoch;
inline Stride& stride_at(const VectorClock& clock, std::uint32_t at) {
  return *reinterpret_cast<Stride*>(clock.epochs + at);
}
constexpr std::uint32_t whole_strides(std::uint32_t size) { return (size + stride - 1) / stride * stride; }

[[gnu::noinline]] inline void grow(VectorClock& clock, std::uint32_t size, Arena& arena) {
  if (size > clock.room) {
    const std::uint32_t room = size < 8 ? 8 : 2 * whole_strides(size);
    Epoch* epochs = static_cast<Epoch*>(arena.take(room * sizeof(Epoch)));
    if (clock.size != 0) std::memcpy(epochs, clock.epochs, clock.size * sizeof(Epoch));
    clock.epochs = epochs;
    clock.room = room;
  }
  std::memset(clock.epochs + clock.size, 0, (whole_strides(size) - clock.size) * sizeof(Epoch));
  clock.size = size;
}

inline void extend(VectorClock& clock, std::uint32_t size, Arena& arena) {
  if (__builtin_expect(size > clock.size, 0)) grow(clock, size, arena);
}

/// `clock` becomes the element-wise maximum of both.
inline void join(VectorClock& clock, const VectorClock& other, Arena& arena) {
  extend(clock, other.size, arena);
  for (std::uint32_t i = 0; i < other.size; i += stride) {
    const Stride own = stride_at(clock, i), others = stride_at(other, i);
    stride_at(clock, i) = others > own ? others : own;
  }
}

/// Both become the element-wise maximum of both.
inline void meet(VectorClock& one, VectorClock& other, Arena& arena) {
  extend(one, other.size, arena);
  extend(other, one.size, arena);
  for (std::uint32_t i = 0; i < one.size; i += stride) {
    const Stride a = stride_at(one, i), b = stride_at(other, i);
    stride_at(one, i) = stride_at(other, i) = a > b ? a : b;
  }
}

/// `clock` becomes a copy of `other`.
inline void assign(VectorClock& clock, const VectorClock& other, Arena& arena) {
  clock.size = 0;
  extend(clock, other.size, arena);
  if (other.size != 0) std::memcpy(clock.epochs, other.epochs, other.size * sizeof(Epoch));
}

}  // namespace waitpoint::races
