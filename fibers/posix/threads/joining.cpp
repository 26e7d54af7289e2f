// SPDX-License-Identifier: BSD-3-Clause
//
// Threads as others see them: waiting for their end, detaching them, comparing their ids.
#include <pthread.h>

#include <cerrno>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/threads/thread.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {

bool are_equal(pthread_t one, pthread_t other) {
  if (is_simulated() && ++this_thread().comparisons >= operations_at_once) {
    this_thread().comparisons = 0;
    spend(record->settings.call_cost * operations_at_once);
    pass(kernel::Operation::poll, nullptr);
  }
  return one == other;
}

namespace {

// Scope of a wait for the end of a thread; a handler may leave it by pthread_exit().
class Joining {
 public:
  explicit Joining(Thread& thread) : thread_(thread) { thread_.has_joiner = true; }
  ~Joining() { thread_.has_joiner = false; }
  Joining(const Joining&) = delete;
  Joining& operator=(const Joining&) = delete;

 private:
  Thread& thread_;
};

}  // namespace

int join(pthread_t id, void** result, Time deadline) {
  Thread* const thread = find(id);
  if (thread == nullptr || thread->is_gone) {
    note_misuse("joins a thread that was joined before, or has ended detached");
    return ESRCH;
  }
  if (thread == &this_thread()) return deadline == Time() ? EBUSY : EDEADLK;
  if (thread->detached || thread->has_joiner) {
    note_misuse(thread->detached ? "joins a detached thread" : "joins a thread that another one joins");
    return EINVAL;
  }
  if (!thread->ended)
    for (const kernel::Task* waiter = this_thread().end.first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
      if (waiter == thread->task) return EDEADLK;
  const CancellationPoint point;
  pass(kernel::Operation::join, &thread->end);
  if (!thread->ended) {
    if (deadline <= kernel::running->local_time) return deadline == Time() ? EBUSY : ETIMEDOUT;
    Wait ended = Wait::came;
    {
      const Joining joining(*thread);
      while (!thread->ended && (ended = point.block(thread->end, deadline)) == Wait::interrupted &&
             !point.was_cancelled())
        handle_signals();
    }
    if (!thread->ended) {
      if (point.was_cancelled()) leave_if_cancelled();
      if (ended == Wait::timed_out) return ETIMEDOUT;
    }
  }
  if (result != nullptr) *result = thread->result;
  let_go(*thread);
  return 0;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_join(pthread_t id, void** result) { return join(id, result, Time::max()); }

// Time() is no deadline: the call does not wait.
WAITPOINT_INTERPOSED int pthread_tryjoin_np(pthread_t id, void** result) noexcept { return join(id, result, Time()); }

WAITPOINT_INTERPOSED int pthread_clockjoin_np(pthread_t id, void** result, clockid_t clock, const timespec* deadline) {
  if (deadline == nullptr) return join(id, result, Time::max());
  if (!is_valid(*deadline) || !is_clock_of_deadlines(clock)) return EINVAL;
  const Time time = when(clock, *deadline);
  return join(id, result, time > Time() ? time : Time::from_ns(1));
}

WAITPOINT_INTERPOSED int pthread_timedjoin_np(pthread_t id, void** result, const timespec* deadline) {
  return pthread_clockjoin_np(id, result, CLOCK_REALTIME, deadline);
}

// The header may define the name inline, so it is given to the assembler.
extern "C" [[gnu::visibility("default")]] int waitpoint_pthread_equal(pthread_t one, pthread_t other) noexcept
    __asm__("pthread_equal");
int waitpoint_pthread_equal(pthread_t one, pthread_t other) noexcept { return are_equal(one, other) ? 1 : 0; }

WAITPOINT_INTERPOSED int pthread_detach(pthread_t id) noexcept {
  Thread* const thread = find(id);
  if (thread == nullptr || thread->is_gone) {
    note_misuse("detaches a thread that was joined before, or has ended detached");
    return ESRCH;
  }
  if (thread->detached) {
    note_misuse("detaches a detached thread");
    return EINVAL;
  }
  pass(kernel::Operation::release, &thread->end);
  thread->detached = true;
  if (thread->ended) let_go(*thread);
  return 0;
}
