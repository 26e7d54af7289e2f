// SPDX-License-Identifier: BSD-3-Clause
// Address space of private zeroed pages, allocated on first use: for the stacks and tables of a run.
#pragma once

#include <cstddef>
#include <span>

namespace waitpoint::kernel {

/// Null if there is none. `flags`: more of mmap()'s.
void* reserve_pages(std::size_t bytes, int flags = 0);
void release_pages(void* memory, std::size_t bytes);

struct ReservedPages {
  void* memory;
  std::size_t bytes;
  bool is_taken;
};

/// Scope in which reserved pages are kept when they are released: later calls of reserve_pages() with the same sizes
/// get them, in their order.
class PagesKept {
 public:
  PagesKept();
  ~PagesKept();
  PagesKept(const PagesKept&) = delete;
  PagesKept& operator=(const PagesKept&) = delete;
};

/// Those that were kept, whether somebody has got them or not.
std::span<const ReservedPages> kept_pages();

}  // namespace waitpoint::kernel
