// SPDX-License-Identifier: BSD-3-Clause
// A map from addresses, or other non-zero words, to small values; open addressing, with its own memory. It is never
// iterated over, so hash order cannot affect a result.
#pragma once

#include <cstdint>
#include <cstring>

#include "fibers/explore/races/arena.hpp"

namespace waitpoint::races {

template <class Value>
class HashTable {
 public:
  /// Null if there is none.
  Value* find(std::uint64_t key) {
    if (size_ == 0) return nullptr;
    Entry& entry = slot(key);
    return entry.key == key ? &entry.value : nullptr;
  }
  /// The value of `key`, initially zero. Valid until the next call.
  Value& operator[](std::uint64_t key) {
    if (2 * size_ >= room_) grow();
    Entry& entry = slot(key);
    if (entry.key != key) {
      entry = {key, Value()};
      ++size_;
    }
    return entry.value;
  }
  void clear() {
    if (size_ != 0) std::memset(static_cast<void*>(entries_), 0, room_ * sizeof(Entry));
    size_ = 0;
  }

 private:
  struct Entry {
    std::uint64_t key;  // 0: free
    Value value;
  };

  Entry& slot(std::uint64_t key) {
    std::uint64_t at = key * 0x9E3779B97F4A7C15u >> shift_;
    while (entries_[at].key != key && entries_[at].key != 0) at = (at + 1) & (room_ - 1);
    return entries_[at];
  }
  void grow() {
    Entry* const old = entries_;
    const std::uint64_t old_room = room_;
    room_ = old_room == 0 ? 256 : 4 * old_room;
    shift_ = 64 - __builtin_ctzll(room_);
    entries_ = static_cast<Entry*>(map_memory(room_ * sizeof(Entry)));
    for (std::uint64_t i = 0; i < old_room; ++i)
      if (old[i].key != 0) slot(old[i].key) = old[i];
    if (old != nullptr) unmap_memory(old, old_room * sizeof(Entry));
  }

  Entry* entries_ = nullptr;
  std::uint64_t room_ = 0;
  std::uint64_t size_ = 0;
  int shift_ = 64;
};

}  // namespace waitpoint::races
