// SPDX-License-Identifier: BSD-3-Clause
// Memory for large arrays that are read here and there: on large pages, where the system has them. On small ones most
// readings of such an array first have to find where their page is, and that may be far away in memory, too.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace waitpoint::world {

/// For std::vector.
template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{2} << 20;

  LargePages() = default;
  template <class Other>
  explicit LargePages(const LargePages<Other>&) {}

  T* allocate(std::size_t count) {
    const std::size_t size = count * sizeof(T);
    if (size < page) return static_cast<T*>(::operator new(size, alignment));
    const std::size_t whole = (size + page - 1) / page * page;
    void* const memory = std::aligned_alloc(page, whole);
    if (memory == nullptr) throw std::bad_alloc();
    madvise(memory, whole, MADV_HUGEPAGE);  // where it is refused, pages are small
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

}  // namespace waitpoint::world
