// SPDX-License-Identifier: BSD-3-Clause
//
// POSIX message queues: the system's own, which keep messages and their order; only waiting is simulated.
#include <fcntl.h>
#include <mqueue.h>

#include <cerrno>
#include <cstdlib>
#include <new>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/timers/notification_threads.hpp"

namespace waitpoint::posix {
namespace {

constexpr timespec long_ago{};

bool is_open_to(mqd_t queue, short events) {
  const int flags = WAITPOINT_NEXT(fcntl)(queue, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != (events == POLLIN ? O_WRONLY : O_RDONLY);
}

bool waits(mqd_t queue) {
  mq_attr attributes{};
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(mq_getattr)(queue, &attributes) == 0 && (attributes.mq_flags & O_NONBLOCK) == 0;
}

// `call` never waits: its deadline is in the past, so it fails with ETIMEDOUT instead.
template <class Call>
ssize_t transfer(mqd_t queue, short events, const timespec* deadline, Call call) {
  if (deadline != nullptr && !can_be_read(deadline)) return fail(EFAULT);
  if (deadline != nullptr && (!is_valid(*deadline) || deadline->tv_sec < 0)) return fail(EINVAL);
  const CancellationPoint point;
  pass(events == POLLIN ? kernel::Operation::receive : kernel::Operation::send, nullptr);
  const bool may_wait = is_open_to(queue, events) && waits(queue);
  for (;;) {
    const ssize_t result = call();
    if (result >= 0) look_at_descriptors();
    if (result >= 0 || errno != ETIMEDOUT || !may_wait) return result;
    const Time until = deadline == nullptr ? Time::max() : when(CLOCK_REALTIME, *deadline);
    const int ready = wait_for(queue, events, until, Restart::if_asked);
    leave_if_cancelled();
    if (ready < 0) return -1;
    if (ready == 0) return fail(ETIMEDOUT);
  }
}

ssize_t receive_before(mqd_t queue, char* bytes, std::size_t size, unsigned* priority, const timespec* deadline) {
  return transfer(queue, POLLIN, deadline,
                  [&] { return WAITPOINT_NEXT(mq_timedreceive)(queue, bytes, size, priority, &long_ago); });
}

int send_before(mqd_t queue, const char* bytes, std::size_t size, unsigned priority, const timespec* deadline) {
  const ssize_t result = transfer(queue, POLLOUT, deadline, [&] {
    return static_cast<ssize_t>(WAITPOINT_NEXT(mq_timedsend)(queue, bytes, size, priority, &long_ago));
  });
  handle_what_came_with_a_call();
  return static_cast<int>(result);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED ssize_t mq_receive(mqd_t queue, char* bytes, std::size_t size, unsigned* priority) {
  if (!is_simulated()) return WAITPOINT_NEXT(mq_receive)(queue, bytes, size, priority);
  return receive_before(queue, bytes, size, priority, nullptr);
}
WAITPOINT_INTERPOSED ssize_t mq_timedreceive(mqd_t queue, char* __restrict bytes, std::size_t size,
                                             unsigned* __restrict priority, const timespec* __restrict deadline) {
  if (!is_simulated()) return WAITPOINT_NEXT(mq_timedreceive)(queue, bytes, size, priority, deadline);
  return receive_before(queue, bytes, size, priority, deadline);
}
WAITPOINT_INTERPOSED int mq_send(mqd_t queue, const char* bytes, std::size_t size, unsigned priority) {
  if (!is_simulated()) return WAITPOINT_NEXT(mq_send)(queue, bytes, size, priority);
  return send_before(queue, bytes, size, priority, nullptr);
}
WAITPOINT_INTERPOSED int mq_timedsend(mqd_t queue, const char* bytes, std::size_t size, unsigned priority,
                                      const timespec* deadline) {
  if (!is_simulated()) return WAITPOINT_NEXT(mq_timedsend)(queue, bytes, size, priority, deadline);
  return send_before(queue, bytes, size, priority, deadline);
}

// The system reports a message by a signal, even if the program asked for a thread.
WAITPOINT_INTERPOSED int mq_notify(mqd_t queue, const sigevent* event) noexcept {
  if (!is_simulated() || event == nullptr || event->sigev_notify != SIGEV_THREAD)
    return before_call<"mq_notify">(changing(place::channels)), WAITPOINT_NEXT(mq_notify)(queue, event);
  before_call<"mq_notify">(changing(place::channels));
  void* const memory = std::malloc(sizeof(Notice));
  auto* const notice = memory != nullptr ? new (memory) Notice() : nullptr;
  if (notice == nullptr || !notice->prepare(*event)) return fail(ENOMEM);
  sigevent by_signal{};
  by_signal.sigev_notify = SIGEV_SIGNAL;
  by_signal.sigev_signo = bell;
  by_signal.sigev_value.sival_ptr = notice;
  expect_ring_from_outside(1);
  if (WAITPOINT_NEXT(mq_notify)(queue, &by_signal) == 0) return 0;
  const ErrorNumberKept kept;
  expect_ring_from_outside(-1);
  notice->~Notice();
  std::free(memory);
  return -1;
}
