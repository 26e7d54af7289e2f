// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/library_calls.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/futex.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iterator>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/sync/futex.hpp"
#include "fibers/posix/traps/library_range.hpp"
#include "fibers/posix/traps/raw_calls.hpp"

namespace waitpoint::posix {
namespace {

bool is_trapped = false;

/// The arguments of a system call, from the processor's registers.
struct Words {
  explicit Words(const greg_t* registers)
      : at{registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
           registers[REG_R10], registers[REG_R8],  registers[REG_R9]} {}
  long at[6];
};

long call_system(long number, const Words& words) {
  return call_directly(number, words.at[0], words.at[1], words.at[2], words.at[3], words.at[4], words.at[5]);
}

// Waits until the descriptor is ready, as read() and write() do; false if a signal handler ended the wait.
bool wait_until_ready(int descriptor, short events) {
  if (class_of(descriptor) == DescriptorClass::file || !may_wait_for(descriptor, events)) return true;
  const auto operation = events == POLLIN ? kernel::Operation::receive : kernel::Operation::send;
  pass(operation, nullptr);
  return wait_for(descriptor, events, Time::max(), Restart::if_asked) >= 0;
}

long read_or_write(long number, const Words& words) {
  const auto descriptor = static_cast<int>(words.at[0]);
  if (!wait_until_ready(descriptor, number == SYS_read ? POLLIN : POLLOUT)) return -EINTR;
  const short events = number == SYS_read ? POLLIN : POLLOUT;
  const family::Changes changes = changes_at(descriptor, events);
  // What a pipe does not take the C library writes by another call.
  void* const bytes = reinterpret_cast<void*>(words.at[1]);
  const auto size = static_cast<std::size_t>(words.at[2]);
  const long result =
      number == SYS_read ? read_at_once(descriptor, bytes, size) : write_at_once(descriptor, bytes, size);
  look_at_descriptors(changes);
  return result;
}

long simulated(long number, const Words& words) {
  if (number != SYS_futex) return read_or_write(number, words);
  // The C library only probes for futexes with priority inheritance: none of its own locks has it.
  const auto operation = static_cast<int>(words.at[1]) & FUTEX_CMD_MASK;
  if (operation > FUTEX_WAKE_BITSET || operation == FUTEX_LOCK_PI || operation == FUTEX_UNLOCK_PI ||
      operation == FUTEX_TRYLOCK_PI)
    return call_system(number, words);
  const long result = futex(reinterpret_cast<std::uint32_t*>(words.at[0]), static_cast<int>(words.at[1]),
                            static_cast<std::uint32_t>(words.at[2]), reinterpret_cast<const timespec*>(words.at[3]),
                            reinterpret_cast<std::uint32_t*>(words.at[4]), static_cast<std::uint32_t>(words.at[5]));
  return result >= 0 ? result : -errno;
}

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

// The C library locks a FILE* for each character only once its own pthread_create() has made a second thread.
void tell_of_threads() {
  pthread_t id = 0;
  const auto nothing = [](void* unused) { return unused; };
  const auto create = of_c_library(&pthread_create, "pthread_create");
  if (create(&id, nullptr, nothing, nullptr) == 0) WAITPOINT_NEXT(pthread_join)(id, nullptr);
}

bool can_be_told_from_others(LibraryRange range) {
  return range.begin < range.end && high(range.begin) == high(range.end);
}

/// Of code in a range: the waits on futexes; these, and reading and writing; reading and writing of one descriptor.
enum class Trapped : std::uint8_t { futexes, futexes_and_streams, stream };

// False if the system does not allow it.
bool trap(LibraryRange range, Trapped what, std::uint32_t descriptor = 0) {
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
  is_trapped = true;
  install(SIGSYS);
  // Without its privileges a process must first give up to gain any.
  const auto set = [&program] {
    return WAITPOINT_NEXT(prctl)(PR_SET_SECCOMP, static_cast<long>(SECCOMP_MODE_FILTER), &program) == 0;
  };
  return set() || (WAITPOINT_NEXT(prctl)(PR_SET_NO_NEW_PRIVS, 1L, 0L, 0L, 0L) == 0 && set());
}

}  // namespace

void trap_library_calls() {
  tell_of_threads();
  const LibraryRange range = range_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  if (!can_be_told_from_others(range))
    refuse("--trap-libc: the C library lies where its calls cannot be told from others");
  if (!trap(range, Trapped::futexes_and_streams)) refuse("--trap-libc: the system does not let its calls be trapped");
}

void answer_inherited_traps() {
  is_trapped = true;
  install(SIGSYS);
}

void trap_stream(int descriptor) {
  static const LibraryRange range = range_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  if (!is_inside(descriptor)) return;
  if (!can_be_told_from_others(range) || !trap(range, Trapped::stream, static_cast<std::uint32_t>(descriptor)))
    end_counting(descriptor);
}

void trap_open_mp() {
  static bool is_done = false;
  static unsigned long long loaded = 0;
  if (is_done || are_raw_calls_trapped()) return;
  const unsigned long long now = libraries_loaded();
  if (now == loaded) return;
  loaded = now;
  const LibraryRange range = range_of_library_named("libgomp.so");
  is_done = can_be_told_from_others(range) && trap(range, Trapped::futexes);
}

bool are_library_calls_trapped() { return is_trapped; }

bool answer_library_call(const siginfo_t& information, void* context) {
  if (!is_trapped || information.si_code != 1) return false;  // SYS_SECCOMP
  // The program may have a filter of its own, for others.
  const int number = information.si_syscall;
  if (number != SYS_futex && number != SYS_read && number != SYS_write) return false;
  const ErrorNumberKept kept;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const Words words(registers);
  registers[REG_RAX] = is_simulated() ? simulated(number, words) : call_system(number, words);
  return true;
}

}  // namespace waitpoint::posix
