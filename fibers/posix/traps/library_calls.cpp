// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/library_calls.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <linux/magic.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <ucontext.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/sync/futex.hpp"
#include "fibers/posix/traps/call_filter.hpp"
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

// The C library locks a FILE* for each character only once its own pthread_create() has made a second thread.
void tell_of_threads() {
  pthread_t id = 0;
  const auto nothing = [](void* unused) { return unused; };
  const auto create = of_c_library(&pthread_create, "pthread_create");
  if (create(&id, nullptr, nothing, nullptr) == 0) WAITPOINT_NEXT(pthread_join)(id, nullptr);
}

bool trap(LibraryRange range, Trapped what, std::uint32_t descriptor = 0) {
  is_trapped = true;
  install(SIGSYS);
  return install_filter(range, what, descriptor);
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

namespace {

// Outside as it counts, but mostly with its other end in a process of the family: a socket, by the loopback, and a
// named pipe. Other pipes outside are the user's.
bool may_be_of_family(int descriptor) {
  struct stat status {};
  struct statfs system {};
  const ErrorNumberKept kept;
  if (WAITPOINT_NEXT(fstat)(descriptor, &status) != 0) return false;
  if (S_ISFIFO(status.st_mode)) return fstatfs(descriptor, &system) == 0 && system.f_type != PIPEFS_MAGIC;
  return S_ISSOCK(status.st_mode);
}

}  // namespace

void trap_stream(int descriptor) {
  static const LibraryRange range = range_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  static std::uint64_t trapped[known_descriptors_max / 64];
  if (descriptor < 0 || descriptor >= known_descriptors_max) return;
  if (!is_inside(descriptor) && !may_be_of_family(descriptor)) return;
  const std::uint64_t bit = std::uint64_t{1} << (descriptor % 64);
  std::uint64_t& word = trapped[descriptor / 64];
  if ((word & bit) != 0) return;
  word |= bit;
  if (!can_be_told_from_others(range) || !trap(range, Trapped::stream, static_cast<std::uint32_t>(descriptor)))
    note_stream(descriptor);
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
