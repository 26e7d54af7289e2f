// SPDX-License-Identifier: BSD-3-Clause
// Memory of the race runtime, allocated directly from the system: the runtime intercepts the program's malloc, so it
// must not call it.
//
//   Arena   pieces that live until the end of a run: clocks, synchronisation points. Addresses are stable.
//   Table   a growing array of plain records by index. Its address changes when it grows.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"

namespace waitpoint::races {

/// Zeroed pages that are taken first; none by default.
struct PagesAhead {
  char *begin = nullptr, *at = nullptr, *end = nullptr;
  bool contains(const void* memory) const { return memory >= begin && memory < end; }
};
extern PagesAhead pages_ahead;

inline void* map_memory(std::size_t bytes) {
  constexpr std::size_t page = 4096;
  const std::size_t whole = (bytes + page - 1) / page * page;
  if (whole <= static_cast<std::size_t>(pages_ahead.end - pages_ahead.at)) {
    pages_ahead.at += whole;
    return pages_ahead.at - whole;
  }
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  WAITPOINT_CHECK(memory != MAP_FAILED, "out of memory for the records of memory accesses");
  return memory;
}

inline void unmap_memory(void* memory, std::size_t bytes) {
  if (!pages_ahead.contains(memory)) munmap(memory, bytes);
}

/// Its contents move to larger memory.
inline void* grow_memory(void* old, std::size_t old_bytes, std::size_t bytes) {
  if (!pages_ahead.contains(old)) {
    void* const grown = mremap(old, old_bytes, bytes, MREMAP_MAYMOVE);
    WAITPOINT_CHECK(grown != MAP_FAILED, "out of memory for the records of memory accesses");
    return grown;
  }
  void* const grown = map_memory(bytes);
  std::memcpy(grown, old, old_bytes);
  return grown;
}

class Arena {
 public:
  /// Not cleared.
  void* take(std::size_t bytes) {
    bytes = (bytes + 15) / 16 * 16;
    while (at_ == nullptr || used_ + bytes > at_->size) advance(bytes);
    char* piece = reinterpret_cast<char*>(at_ + 1) + used_;
    used_ += bytes;
    return piece;
  }
  /// Frees all pieces.
  void reset() {
    at_ = first_;
    used_ = 0;
  }

 private:
  struct alignas(16) Chunk {
    Chunk* next;
    std::size_t size;
  };
  static constexpr std::size_t chunk_size = std::size_t{1} << 18;

  void advance(std::size_t bytes) {
    Chunk*& next = at_ == nullptr ? first_ : at_->next;
    if (next == nullptr || next->size < bytes) {
      const std::size_t size = bytes > chunk_size ? bytes : chunk_size;
      Chunk* chunk = static_cast<Chunk*>(map_memory(sizeof(Chunk) + size));
      *chunk = {next, size};
      next = chunk;
    }
    at_ = next;
    used_ = 0;
  }

  Chunk* first_ = nullptr;
  Chunk* at_ = nullptr;
  std::size_t used_ = 0;
};

template <class T>
class Table {
 public:
  T& operator[](std::uint32_t index) { return records_[index]; }
  std::uint32_t size() const { return size_; }
  /// Adds an element and returns its index; its contents are old or zero.
  std::uint32_t add() {
    if (size_ == room_) grow();
    return size_++;
  }
  void remove_last() { --size_; }
  void reset() { size_ = 0; }

 private:
  void grow() {
    const std::uint32_t room = room_ == 0 ? 1024 : 2 * room_;
    records_ = static_cast<T*>(room_ == 0 ? map_memory(room * sizeof(T))
                                          : grow_memory(records_, room_ * sizeof(T), room * sizeof(T)));
    room_ = room;
  }

  T* records_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint32_t room_ = 0;
};

}  // namespace waitpoint::races
