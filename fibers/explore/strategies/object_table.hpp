// SPDX-License-Identifier: BSD-3-Clause
// A value for each object of a schedule, by identity: open addressing, emptied in no time and without giving back its
// memory, since there are schedules in thousands. It is never iterated over, so hash order cannot affect a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace waitpoint::exploration {

template <class Value>
class ObjectTable {
 public:
  void clear() {
    ++round_;
    used_ = 0;
  }
  /// The object's value, at first Value(). Valid until the next call.
  Value& operator[](std::uint64_t object) {
    if (2 * used_ >= slots_.size()) grow();
    Slot& slot = slot_of(object);
    if (slot.round != round_) {
      slot = {object, round_, Value()};
      ++used_;
    }
    return slot.value;
  }

 private:
  static constexpr std::size_t room_at_first = 64;  // a power of two

  struct Slot {
    std::uint64_t object = 0;
    std::uint64_t round = 0;  // of clear() that it is of; 0: none
    Value value = Value();
  };

  Slot& slot_of(std::uint64_t object) {
    std::size_t at = object * 0x9E3779B97F4A7C15u >> 32 & (slots_.size() - 1);
    while (slots_[at].round == round_ && slots_[at].object != object) at = (at + 1) & (slots_.size() - 1);
    return slots_[at];
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? room_at_first : 4 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.round == round_) slot_of(slot.object) = slot;
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::uint64_t round_ = 1;
};

}  // namespace waitpoint::exploration
