// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/call_filter.hpp"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

constexpr sock_filter statement(int code, std::uint32_t value) {
  return {static_cast<std::uint16_t>(code), 0, 0, value};
}
constexpr sock_filter jump(int code, std::uint32_t value, std::uint8_t if_so, std::uint8_t if_not) {
  return {static_cast<std::uint16_t>(code), if_so, if_not, value};
}

// True if each jump leads to a statement behind it, and the last statement returns.
template <std::size_t size>
bool is_closed(const sock_filter (&filter)[size]) {
  for (std::size_t at = 0; at < size; ++at)
    if (BPF_CLASS(filter[at].code) == BPF_JMP && at + 1 + std::max(filter[at].jt, filter[at].jf) >= size) return false;
  return BPF_CLASS(filter[size - 1].code) == BPF_RET;
}

constexpr std::uint32_t low(std::uintptr_t address) { return static_cast<std::uint32_t>(address); }
constexpr std::uint32_t high(std::uintptr_t address) { return static_cast<std::uint32_t>(address >> 32); }

}  // namespace

bool can_be_told_from_others(LibraryRange range) {
  return range.begin < range.end && high(range.begin) == high(range.end);
}

bool install_filter(LibraryRange range, Trapped what, std::uint32_t descriptor) {
  constexpr int load = BPF_LD | BPF_W | BPF_ABS, is = BPF_JMP | BPF_JEQ | BPF_K, is_least = BPF_JMP | BPF_JGE | BPF_K;
  constexpr std::uint32_t at = offsetof(seccomp_data, instruction_pointer);
  static_assert(at % sizeof(std::uint32_t) == 0 && sizeof(seccomp_data::instruction_pointer) == 8 &&
                sizeof(seccomp_data::nr) == 4);
  WAITPOINT_CHECK(can_be_told_from_others(range), "the filter cannot compare addresses of this range");
  const bool any_descriptor = what != Trapped::stream;
  const std::uint32_t waiting = any_descriptor ? SYS_futex : SYS_read;
  const std::uint32_t reading = what == Trapped::futexes ? SYS_futex : SYS_read;
  const std::uint32_t writing = what == Trapped::futexes ? SYS_futex : SYS_write;
  sock_filter filter[] = {
      statement(load, offsetof(seccomp_data, arch)),
      jump(is, AUDIT_ARCH_X86_64, 0, 12),
      statement(load, offsetof(seccomp_data, nr)),
      jump(is, waiting, 2, 0),
      jump(is, reading, 1, 0),
      jump(is, writing, 0, 8),
      statement(load, offsetof(seccomp_data, args)),
      any_descriptor ? jump(is_least, 0, 0, 6) : jump(is, descriptor, 0, 6),
      statement(load, at + 4),
      jump(is, high(range.begin), 0, 4),
      statement(load, at),
      jump(is_least, low(range.begin), 0, 2),
      jump(is_least, low(range.end), 1, 0),
      statement(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  static_assert(std::size(filter) <= BPF_MAXINSNS);
  WAITPOINT_CHECK(is_closed(filter), "a jump of the filter leads out of it");
  const sock_fprog program{sizeof filter / sizeof *filter, filter};
  // Without its privileges a process must first give up to gain any.
  const auto set = [&program] {
    return WAITPOINT_NEXT(prctl)(PR_SET_SECCOMP, static_cast<long>(SECCOMP_MODE_FILTER), &program) == 0;
  };
  return set() || (WAITPOINT_NEXT(prctl)(PR_SET_NO_NEW_PRIVS, 1L, 0L, 0L, 0L) == 0 && set());
}

}  // namespace waitpoint::posix
