// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/signals/cancellation.hpp"

#include <cerrno>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/computing_watch.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

namespace {

// The object of sleeping threads: only a cancellation or a signal wakes them.
kernel::Object sleepers{"sleep"};

}  // namespace

void leave_if_cancelled() {
  Thread& thread = this_thread();
  if (!is_to_leave(thread)) return;
  thread.in_cancellation_point = false;
  pthread_exit(PTHREAD_CANCELED);
}

bool CancellationPoint::wait_until(Time time) const {
  kernel::Task& task = *kernel::running;
  kernel::enter(sleepers);
  pass(kernel::Operation::sleep, &sleepers);
  bool goes_on = true;
  while (goes_on && time > kernel::local_time(task)) {
    const Wait ended = block(sleepers, time);
    leave_if_cancelled();
    goes_on = ended != Wait::interrupted || !is_interrupted(Restart::never);
  }
  leave_if_cancelled();
  return goes_on;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_cancel(pthread_t id) {
  Thread* const thread = find(id);
  if (thread == nullptr || thread->ended) return thread == nullptr ? ESRCH : 0;
  pass(kernel::Operation::signal, &thread->end);
  if (thread->ended) return 0;
  thread->cancelled = true;
  if (thread->cancel_disabled || thread->exiting) return 0;
  if (thread == &this_thread()) {
    if (thread->cancel_at_once) leave_if_cancelled();
    return 0;
  }
  // One whose wait has ended otherwise completes its call, and exits at the next point: it has consumed what came.
  const bool is_waiting = thread->task->state == kernel::TaskState::blocked &&
                          (thread->in_cancellation_point || (thread->cancel_at_once && thread->in_wait));
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (is_waiting) {
    thread->woken_early = true;
    kernel::wake(scheduler, *thread->task);
  } else if (thread->cancel_at_once) {
    kernel::attend(*thread->task, kernel::attention::signal, true);
  }
  return 0;
}

WAITPOINT_INTERPOSED int pthread_setcancelstate(int state, int* old) {
  if (state != PTHREAD_CANCEL_ENABLE && state != PTHREAD_CANCEL_DISABLE) return EINVAL;
  if (!is_simulated()) return WAITPOINT_NEXT(pthread_setcancelstate)(state, old);
  Thread& thread = this_thread();
  if (old != nullptr) *old = thread.cancel_disabled ? PTHREAD_CANCEL_DISABLE : PTHREAD_CANCEL_ENABLE;
  thread.cancel_disabled = state == PTHREAD_CANCEL_DISABLE;
  if (thread.cancel_at_once) leave_if_cancelled();
  if (thread.cancel_at_once && expect_computing != nullptr) expect_computing();
  return 0;
}

WAITPOINT_INTERPOSED int pthread_setcanceltype(int type, int* old) {
  if (type != PTHREAD_CANCEL_DEFERRED && type != PTHREAD_CANCEL_ASYNCHRONOUS) return EINVAL;
  if (!is_simulated()) return WAITPOINT_NEXT(pthread_setcanceltype)(type, old);
  Thread& thread = this_thread();
  if (old != nullptr) *old = thread.cancel_at_once ? PTHREAD_CANCEL_ASYNCHRONOUS : PTHREAD_CANCEL_DEFERRED;
  thread.cancel_at_once = type == PTHREAD_CANCEL_ASYNCHRONOUS;
  if (thread.cancel_at_once) leave_if_cancelled();
  if (thread.cancel_at_once && expect_computing != nullptr) expect_computing();
  return 0;
}

WAITPOINT_INTERPOSED void pthread_testcancel() {
  if (!is_simulated()) return;
  pass(kernel::Operation::poll, nullptr);
  leave_if_cancelled();
}
