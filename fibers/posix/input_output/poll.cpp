// SPDX-License-Identifier: BSD-3-Clause
//
// Waiting for several descriptors: poll, select and epoll, with their timeouts in virtual time.
#include <poll.h>
#include <sys/epoll.h>
#include <sys/select.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/epoll_watches.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/temporary_mask.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

Time deadline_in(Duration span) { return later(kernel::local_time(*kernel::running), span); }
Time deadline_in_ms(int timeout_ms) {
  return timeout_ms < 0 ? Time::max() : deadline_in(std::chrono::milliseconds(timeout_ms));
}

int wait(pollfd* descriptors, nfds_t count, Time deadline) {
  // Errors are reported at once: unreadable arrays, too many descriptors.
  WAITPOINT_FAST_CHECK(!this_thread().in_wait, "a thread waits for descriptors within another wait");
  if (WAITPOINT_NEXT(poll)(descriptors, count, 0) < 0) return -1;
  const bool has_closed =
      std::any_of(descriptors, descriptors + count, [](const pollfd& each) { return (each.revents & POLLNVAL) != 0; });
  const CancellationPoint point;
  const bool has_temporary_mask = this_thread().has_temporary_mask;
  pass(kernel::Operation::poll, nullptr);
  if (has_temporary_mask && !this_thread().has_temporary_mask) return fail(EINTR);
  const int ready = wait_for(descriptors, count, has_closed ? kernel::running->local_time : deadline, Restart::never);
  // Signals that were pending interrupt the call even with a timeout of zero.
  if (ready == 0 && deliverable(this_thread()) != 0 && is_interrupted(Restart::never)) return fail(EINTR);
  // It takes time, so that a polling loop ends.
  if (ready == 0) read_clock();
  leave_if_cancelled();
  return ready;
}

bool is_none_or_readable(const void* address) { return address == nullptr || can_be_read(address); }

// Returns an error number or 0.
int error_of(const timespec* timeout) {
  if (!is_none_or_readable(timeout)) return EFAULT;
  return timeout == nullptr || (is_valid(*timeout) && timeout->tv_sec >= 0) ? 0 : EINVAL;
}

// The descriptors of three sets, in the form of poll().
class Sets {
 public:
  Sets(int count, fd_set* readable, fd_set* writable, fd_set* urgent)
      : count_(count < FD_SETSIZE ? count : FD_SETSIZE), sets_{readable, writable, urgent} {
    for (int fd = 0; fd < count_; ++fd) {
      short events = 0;
      for (int i = 0; i < 3; ++i)
        if (sets_[i] != nullptr && FD_ISSET(fd, sets_[i])) events = static_cast<short>(events | asked[i]);
      if (events != 0) polled_[size_++] = {fd, events, 0};
    }
  }
  pollfd* polled() { return polled_; }
  nfds_t size() const { return size_; }

  /// Reduces the sets to the ready descriptors, and returns the number of bits; -1 if a descriptor is not open.
  int keep_ready() {
    for (nfds_t i = 0; i < size_; ++i)
      if ((polled_[i].revents & POLLNVAL) != 0) return fail(EBADF);
    int bits = 0;
    for (int i = 0; i < 3; ++i) {
      if (sets_[i] == nullptr) continue;
      FD_ZERO(sets_[i]);
      for (nfds_t k = 0; k < size_; ++k) {
        WAITPOINT_FAST_CHECK(polled_[k].fd >= 0 && polled_[k].fd < FD_SETSIZE, "a set has a descriptor beyond its end");
        if ((polled_[k].events & asked[i]) != 0 && (polled_[k].revents & answered[i]) != 0) {
          FD_SET(polled_[k].fd, sets_[i]);
          ++bits;
        }
      }
    }
    return bits;
  }

 private:
  static constexpr short asked[3] = {POLLIN, POLLOUT, POLLPRI};
  static constexpr short answered[3] = {POLLIN | POLLHUP | POLLERR, POLLOUT | POLLERR, POLLPRI};

  int count_;
  fd_set* sets_[3];
  pollfd polled_[FD_SETSIZE];
  nfds_t size_ = 0;
};

int select_before(int count, fd_set* readable, fd_set* writable, fd_set* urgent, Time deadline) {
  for (const fd_set* set : {readable, writable, urgent})
    if (count > 0 && !is_none_or_readable(set)) return fail(EFAULT);
  Sets sets(count, readable, writable, urgent);
  if (wait(sets.polled(), sets.size(), deadline) < 0) return -1;
  return sets.keep_ready();
}

// An epoll descriptor is ready when one that it watches is.
int epoll_before(int descriptor, epoll_event* events, int most, Time deadline, const sigset_t* mask) {
  if (most <= 0) return fail(EINVAL);
  pollfd one{descriptor, POLLIN, 0};
  const TemporaryMask blocked(mask);
  for (bool is_first = true;; is_first = false) {
    if (!is_first && wait(&one, 1, deadline) < 0) return -1;
    if (is_first) pass(kernel::Operation::poll, nullptr);
    // Another thread may have taken the events. A descriptor that is no epoll's fails at once.
    const int ready = WAITPOINT_NEXT(epoll_pwait)(descriptor, events, most, 0, nullptr);
    put_in_order(descriptor, events, ready);
    if (ready != 0 || (!is_first && deadline <= kernel::running->local_time)) return ready;
  }
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  if (!is_simulated()) return WAITPOINT_NEXT(poll)(descriptors, count, timeout_ms);
  return posix::wait(descriptors, count, deadline_in_ms(timeout_ms));
}

WAITPOINT_INTERPOSED int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout, const sigset_t* mask) {
  if (!is_simulated()) return WAITPOINT_NEXT(ppoll)(descriptors, count, timeout, mask);
  if (const int error = error_of(timeout); error != 0) return fail(error);
  const TemporaryMask blocked(mask);
  return posix::wait(descriptors, count, timeout == nullptr ? Time::max() : deadline_in(span(*timeout)));
}

WAITPOINT_INTERPOSED int select(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                                fd_set* __restrict urgent, timeval* __restrict timeout) {
  if (!is_simulated()) return WAITPOINT_NEXT(select)(count, readable, writable, urgent, timeout);
  if (!is_none_or_readable(timeout)) return fail(EFAULT);
  if (count < 0 || (timeout != nullptr && (timeout->tv_sec < 0 || timeout->tv_usec < 0))) return fail(EINVAL);
  if (timeout == nullptr) return select_before(count, readable, writable, urgent, Time::max());
  // Linux stores the remaining time in it.
  const Time deadline = deadline_in(span({timeout->tv_sec, timeout->tv_usec * 1000}));
  const int ready = select_before(count, readable, writable, urgent, deadline);
  const std::int64_t left_ns = (deadline - kernel::running->local_time).ns();
  const timespec left = to_timespec(left_ns > 0 ? left_ns : 0);
  *timeout = {left.tv_sec, left.tv_nsec / 1000};
  return ready;
}

WAITPOINT_INTERPOSED int pselect(int count, fd_set* __restrict readable, fd_set* __restrict writable,
                                 fd_set* __restrict urgent, const timespec* __restrict timeout,
                                 const sigset_t* __restrict mask) {
  if (!is_simulated()) return WAITPOINT_NEXT(pselect)(count, readable, writable, urgent, timeout, mask);
  if (const int error = error_of(timeout); error != 0) return fail(error);
  if (mask != nullptr && !can_be_read(mask)) return fail(EFAULT);
  if (count < 0) return fail(EINVAL);
  const TemporaryMask blocked(mask);
  return select_before(count, readable, writable, urgent,
                       timeout == nullptr ? Time::max() : deadline_in(span(*timeout)));
}

WAITPOINT_INTERPOSED int epoll_pwait(int descriptor, epoll_event* events, int most, int timeout_ms,
                                     const sigset_t* mask) {
  if (!is_simulated()) return WAITPOINT_NEXT(epoll_pwait)(descriptor, events, most, timeout_ms, mask);
  return epoll_before(descriptor, events, most, deadline_in_ms(timeout_ms), mask);
}

WAITPOINT_INTERPOSED int epoll_pwait2(int descriptor, epoll_event* events, int most, const timespec* timeout,
                                      const sigset_t* mask) {
  if (!is_simulated()) return WAITPOINT_NEXT(epoll_pwait2)(descriptor, events, most, timeout, mask);
  if (const int error = error_of(timeout); error != 0) return fail(error);
  return epoll_before(descriptor, events, most, timeout == nullptr ? Time::max() : deadline_in(span(*timeout)), mask);
}

WAITPOINT_INTERPOSED int epoll_wait(int descriptor, epoll_event* events, int most, int timeout_ms) {
  return epoll_pwait(descriptor, events, most, timeout_ms, nullptr);
}
