// SPDX-License-Identifier: BSD-3-Clause
//
// fork(): the child goes on as a simulation of its own, with the thread that called; programs that it starts are not
// simulated. And waiting for children, who take real time.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "fibers/posix/cancellation.hpp"
#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/interval_timers.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/signals.hpp"
#include "fibers/posix/waiting.hpp"

namespace waitpoint::posix {
namespace {

// What the child does is not what `waitpoint exec` watches: its record becomes a copy, at the same address.
void take_own_record() {
  void* copy = mmap(nullptr, record_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (copy == MAP_FAILED) refuse("there is no memory for a child's simulation");
  const auto used = static_cast<const char*>(record->arena.top()) - reinterpret_cast<const char*>(record);
  std::memcpy(copy, static_cast<void*>(record), static_cast<std::size_t>(used));
  if (mremap(copy, record_bytes, record_bytes, MREMAP_MAYMOVE | MREMAP_FIXED, record) == MAP_FAILED)
    refuse("there is no memory for a child's simulation");
}

// A descriptor that is ready when the child has ended; not known where there is no such child.
class ChildEnds {
 public:
  explicit ChildEnds(pid_t pid) : descriptor_(static_cast<int>(WAITPOINT_NEXT(syscall)(SYS_pidfd_open, pid, 0))) {}
  ~ChildEnds() {
    if (descriptor_ >= 0) WAITPOINT_NEXT(close)(descriptor_);
  }
  ChildEnds(const ChildEnds&) = delete;
  ChildEnds& operator=(const ChildEnds&) = delete;

  bool known() const { return descriptor_ >= 0; }
  /// False with EINTR if a signal ended the wait.
  bool wait() const { return wait_for(descriptor_, POLLIN, Time::max(), Restart::if_asked) >= 0; }

 private:
  int descriptor_;
};

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED pid_t fork() noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(fork)();
  if (has_host) return fail(ENOSYS);  // a copy of the host is no process of a guest
  pass(kernel::Operation::start, nullptr);
  note_fork();
  const pid_t child = WAITPOINT_NEXT(fork)();
  if (child != 0) return child;
  take_own_record();
  forget_waiters();
  kernel::running->scheduler->keep_running_task_only();
  forget_interval_timers();
  forget_timers();
  forget_pending_signals();
  return 0;
}

// Of one child it is known when it ends; of any, the system is asked, and waited for by it.
WAITPOINT_INTERPOSED pid_t wait4(pid_t pid, int* status, int options, rusage* usage) {
  if (!is_simulated() || (options & WNOHANG) != 0) return WAITPOINT_NEXT(wait4)(pid, status, options, usage);
  const CancellationPoint point;
  pass(kernel::Operation::join, nullptr);
  if (pid > 0) {
    const ChildEnds end(pid);
    const bool is_over = !end.known() || end.wait();
    leave_if_cancelled();
    if (!is_over) return -1;
  }
  return WAITPOINT_NEXT(wait4)(pid, status, options, usage);
}

WAITPOINT_INTERPOSED pid_t waitpid(pid_t pid, int* status, int options) { return wait4(pid, status, options, nullptr); }
WAITPOINT_INTERPOSED pid_t wait(int* status) { return wait4(-1, status, 0, nullptr); }
