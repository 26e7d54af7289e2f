// SPDX-License-Identifier: BSD-3-Clause
// Memory on large pages, where the system has them, for large arrays with random access. On small pages most reads of
// such an array miss the TLB, and the page walk may miss the cache, too.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace waitpoint {

/// An allocator for std::vector.
template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{2} << 20;
  static_assert(alignof(T) <= page, "an element is aligned by its page");

  LargePages() = default;
  template <class Other>
  explicit LargePages(const LargePages<Other>&) {}

  T* allocate(std::size_t count) {
    const std::size_t size = count * sizeof(T);
    if (size < page) return static_cast<T*>(::operator new(size, alignment));
    const std::size_t whole = (size + page - 1) / page * page;
    void* const memory = std::aligned_alloc(page, whole);
    if (memory == nullptr) throw std::bad_alloc();
    madvise(memory, whole, MADV_HUGEPAGE);  // only a hint: if it is refused, pages are small
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < page)
      ::operator delete(memory, alignment);
    else
      std::free(memory);
  }

  friend bool operator==(const LargePages&, const LargePages&) { return true; }

 private:
  static constexpr std::align_val_t alignment{alignof(T)};
};

}  // namespace waitpoint
