// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/followed_calls.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/traps/followed_descriptors.hpp"

namespace waitpoint::posix {
namespace {

// As the system defines it.
struct SystemAction {
  void* handler;
  unsigned long flags;
  void* restorer;
  std::uint64_t mask;
};
constexpr int actions_end = 65;

constexpr std::size_t mappings_max = 64;
LibraryRange mapped[mappings_max], unmapped[mappings_max];
std::size_t mapped_count = 0, unmapped_count = 0;
bool (*may_be_unmapped)(LibraryRange range) = nullptr;

SystemAction actions_before[actions_end];
std::uint64_t mask_before = 0;
bool has_changed[actions_end] = {};
bool has_discarded = false;
bool is_for_snapshots = false;
long break_before = 0;

bool is_mapped_since(std::uintptr_t begin, std::size_t bytes) {
  for (std::size_t i = 0; i < mapped_count; ++i)
    if (begin >= mapped[i].begin && bytes <= mapped[i].end - begin && begin < mapped[i].end) return true;
  return false;
}

long action_of(long signal, SystemAction* action) {
  return call_directly(SYS_rt_sigaction, signal, 0, reinterpret_cast<long>(action), sizeof action->mask);
}

LibraryRange range_of(const CallWords& words) {
  const auto begin = words.word<std::uintptr_t>(0);
  return {begin, begin + (words.word<std::size_t>(1) + 4095) / 4096 * 4096};
}

bool is_mapped_before(const CallWords& words) {
  return unmapped_count < mappings_max && may_be_unmapped(range_of(words));
}

bool can_map(const CallWords& words) {
  constexpr int usual = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK | MAP_FIXED | MAP_DENYWRITE;
  const int flags = words.word<int>(3);
  const bool is_of_run = (flags & MAP_ANONYMOUS) != 0 || is_opened_since(words.word<int>(4));
  if ((flags & ~usual) != 0 || (flags & MAP_PRIVATE) == 0 || !is_of_run || mapped_count == mappings_max) return false;
  return (flags & MAP_FIXED) == 0 || is_mapped_since(words.word<std::uintptr_t>(0), words.word<std::size_t>(1));
}

// The guards of the layer's own stacks are installed again at the same places; what is discarded can be copied back.
bool can_advise(const CallWords& words) {
  constexpr int guard_install = 102;
  const int advice = words.word<int>(2);
  const auto bytes = words.word<std::size_t>(1);
  // For no bytes it changes nothing: so the arena of stacks asks whether advice is heeded.
  return bytes == 0 || advice == MADV_DONTNEED || advice == guard_install ||
         is_mapped_since(words.word<std::uintptr_t>(0), bytes);
}

bool discards(long number, const CallWords& words) {
  if (number == SYS_madvise) return words.at[2] == MADV_DONTNEED;
  return number == SYS_munmap || (number == SYS_brk && words.at[0] != 0);
}

bool is_standard_stream(const CallWords& words) { return words.at[0] >= 0 && words.at[0] <= STDERR_FILENO; }

bool can_be_undone(long number, const CallWords& words) {
  if (is_undone_by_closing(number, words)) return true;
  switch (number) {
    case SYS_mmap: return can_map(words);
    case SYS_munmap:
      return is_mapped_since(words.word<std::uintptr_t>(0), words.word<std::size_t>(1)) || is_mapped_before(words);
    case SYS_mprotect: return is_mapped_since(words.word<std::uintptr_t>(0), words.word<std::size_t>(1));
    case SYS_madvise: return can_advise(words);
    case SYS_read:
    case SYS_write:
    case SYS_readv:
    case SYS_writev:
    case SYS_pread64:
    case SYS_pwrite64:
    case SYS_lseek: return is_standard_stream(words);
    case SYS_ioctl: return words.at[1] == TCGETS;
    case SYS_fcntl:
      return words.at[1] == F_GETFL || words.at[1] == F_GETFD ||
             ((words.at[1] == F_SETFL || words.at[1] == F_SETFD) && is_opened_since(words.word<int>(0)));
    case SYS_poll: return words.at[2] == 0;
    case SYS_prlimit64: return words.at[2] == 0;
    case SYS_brk:
    case SYS_rt_sigaction:
    case SYS_rt_sigprocmask:
    case SYS_fstat:
    case SYS_newfstatat:
    case SYS_statx:
    case SYS_stat:
    case SYS_lstat:
    case SYS_access:
    case SYS_faccessat:
    case SYS_readlink:
    case SYS_getcwd:
    case SYS_futex:
    case SYS_getpid:
    case SYS_gettid:
    case SYS_getppid:
    case SYS_getuid:
    case SYS_geteuid:
    case SYS_getgid:
    case SYS_getegid:
    case SYS_getrlimit:
    case SYS_getrusage:
    case SYS_sched_yield:
    case SYS_sched_getaffinity:
    case SYS_sysinfo:
    case SYS_uname:
    case SYS_times:
    case SYS_clock_gettime:
    case SYS_clock_getres:
    case SYS_gettimeofday:
    case SYS_time:
    case SYS_getrandom: return true;
    default: return false;
  }
}

bool opens_for_reading(long number, const CallWords& words) {
  const int flags = words.word<int>(number == SYS_open ? 1 : 2);
  return (flags & O_ACCMODE) == O_RDONLY && (flags & (O_CREAT | O_TRUNC)) == 0;
}

bool is_copied_by_fork(long number, const CallWords& words) {
  switch (number) {
    case SYS_mmap: return (words.word<int>(3) & MAP_PRIVATE) != 0;
    case SYS_munmap:
    case SYS_mremap:
    case SYS_mprotect:
    case SYS_madvise:
    case SYS_prlimit64:
    case SYS_sigaltstack:
    case SYS_umask: return true;
    case SYS_open:
    case SYS_openat:
      if (!opens_for_reading(number, words)) return false;
      [[fallthrough]];
    default: return can_be_undone(number, words);
  }
}

// The handler's return would set another mask.
long change_mask(const CallWords& words, ucontext_t& context) {
  std::uint64_t now = 0;
  static_assert(sizeof now <= sizeof context.uc_sigmask);
  std::memcpy(&now, &context.uc_sigmask, sizeof now);
  const auto* const set = words.word<const std::uint64_t*>(1);
  auto* const old = words.word<std::uint64_t*>(2);
  const std::uint64_t given = set != nullptr ? *set : 0;
  if (old != nullptr) *old = now;
  if (set == nullptr) return 0;
  switch (words.word<int>(0)) {
    case SIG_BLOCK: now |= given; break;
    case SIG_UNBLOCK: now &= ~given; break;
    case SIG_SETMASK: now = given; break;
    default: return -EINVAL;
  }
  now &= ~(std::uint64_t{1} << (SIGSYS - 1));  // by which calls are trapped: the C library blocks all at times
  std::memcpy(&context.uc_sigmask, &now, sizeof now);
  return 0;
}

}  // namespace

LibraryRange return_from_handlers() {
  SystemAction action{};
  WAITPOINT_CHECK(action_of(SIGSYS, &action) == 0 && action.restorer != nullptr, "SIGSYS has no handler");
  constexpr std::size_t size = 16;  // of two instructions
  const auto begin = reinterpret_cast<std::uintptr_t>(action.restorer);
  return {begin, begin + size};
}

void begin_to_follow_calls(bool (*can_map_again)(LibraryRange range)) {
  may_be_unmapped = can_map_again;
  break_before = call_directly(SYS_brk, 0);
  call_directly(SYS_rt_sigprocmask, SIG_SETMASK, 0, reinterpret_cast<long>(&mask_before), sizeof mask_before);
}

void begin_to_follow_calls_for_snapshots() { is_for_snapshots = true; }

namespace {

// What is needed to undo it.
void note_before(long number, const CallWords& words) {
  if (number == SYS_rt_sigaction && words.at[0] > 0 && words.at[0] < actions_end && !has_changed[words.at[0]])
    has_changed[words.at[0]] = action_of(words.at[0], &actions_before[words.at[0]]) == 0;
  if (number == SYS_munmap && !is_mapped_since(words.word<std::uintptr_t>(0), words.word<std::size_t>(1)))
    unmapped[unmapped_count++] = range_of(words);
  has_discarded = has_discarded || discards(number, words);
}
void note_after(long number, const CallWords& words, long result) {
  if (number == SYS_mmap && result > 0)
    mapped[mapped_count++] = {static_cast<std::uintptr_t>(result),
                              static_cast<std::uintptr_t>(result) + words.word<std::size_t>(1)};
}

}  // namespace

bool follow_call(long number, const CallWords& words, ucontext_t& context) {
  if (is_for_snapshots ? !is_copied_by_fork(number, words) : !can_be_undone(number, words)) return false;
  if (!is_for_snapshots) note_before(number, words);
  const long result = number == SYS_rt_sigprocmask ? change_mask(words, context)
                                                   : call_directly(number, words.at[0], words.at[1], words.at[2],
                                                                   words.at[3], words.at[4], words.at[5]);
  if (!is_for_snapshots) note_after(number, words, result);
  if (result >= 0) note_descriptors(number, words, result);
  context.uc_mcontext.gregs[REG_RAX] = result;
  return true;
}

bool have_calls_discarded() { return has_discarded; }

void undo_calls() {
  close_descriptors_of_run();
  for (std::size_t i = 0; i < mapped_count; ++i)
    call_directly(SYS_munmap, static_cast<long>(mapped[i].begin), static_cast<long>(mapped[i].end - mapped[i].begin));
  for (std::size_t i = 0; i < unmapped_count; ++i)
    call_directly(SYS_mmap, static_cast<long>(unmapped[i].begin),
                  static_cast<long>(unmapped[i].end - unmapped[i].begin), PROT_READ | PROT_WRITE,
                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1);
  call_directly(SYS_brk, break_before);
  for (int signal = 1; signal < actions_end; ++signal)
    if (has_changed[signal])
      call_directly(SYS_rt_sigaction, signal, reinterpret_cast<long>(&actions_before[signal]), 0,
                    sizeof actions_before[signal].mask);
  call_directly(SYS_rt_sigprocmask, SIG_SETMASK, reinterpret_cast<long>(&mask_before), 0, sizeof mask_before);
}

}  // namespace waitpoint::posix
