// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/report_stacks.hpp"

#include <sys/mman.h>
#include <sys/syscall.h>

#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
// The list of the free ones is behind them.
bool ReportStacks::make(void* kept) {
  is_kept_ = kept != nullptr;
  if (is_kept_) {
    memory_ = static_cast<char*>(kept);
  } else {
    const long memory =
        call_directly(SYS_mmap, 0, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory < 0 && memory > -4096) return false;
    memory_ = reinterpret_cast<char*>(memory);
  }
  free_ = reinterpret_cast<std::uint16_t*>(memory_ + count * bytes_of_one);
  static_assert(count * sizeof *free_ <= bytes_of_list);
  call_directly(SYS_sigaltstack, 0, reinterpret_cast<long>(&before_));
  keep_for_system();
  return true;
}

void ReportStacks::remove() {
  call_directly(SYS_sigaltstack, reinterpret_cast<long>(&before_), 0);
  if (!is_kept_) call_directly(SYS_munmap, reinterpret_cast<long>(memory_), bytes);
  memory_ = nullptr;
}

void* ReportStacks::take() {
  if (free_count_ == 0 && used_ == count) return nullptr;
  const std::size_t number = free_count_ > 0 ? free_[--free_count_] : used_++;
  return memory_ + (number + 1) * bytes_of_one;
}

void ReportStacks::give_back(const void* within) {
  free_[free_count_++] = static_cast<std::uint16_t>(number_of(within));
}

void ReportStacks::keep_for_system() const {
  stack_t own{};
  own.ss_sp = memory_;
  own.ss_size = bytes_of_one;
  call_directly(SYS_sigaltstack, reinterpret_cast<long>(&own), 0);
}

}  // namespace waitpoint::posix
