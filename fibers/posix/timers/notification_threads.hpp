// SPDX-License-Identifier: BSD-3-Clause
// Threads that are started to tell of something: SIGEV_THREAD, of timers, message queues and asynchronous input and
// output. As in the C library, a thread of the layer's own makes them; they, and it, block all signals at first.
#pragma once

#include <pthread.h>
#include <signal.h>

namespace waitpoint::posix {

/// A thread of the layer's own; false without memory.
bool start_blocking_signals(void* (*start)(void*), void* argument, const pthread_attr_t* attributes);

/// A thread that tells, started by the running one.
void start_notification(const sigevent& event);

/// What is told by threads, a thread each time that it is rung.
class Notice {
 public:
  Notice();
  ~Notice();
  Notice(const Notice&) = delete;
  Notice& operator=(const Notice&) = delete;

  /// As the program asks for it; false without memory.
  bool prepare(const sigevent& event);
  /// By an event too.
  void ring();

 private:
  friend struct Notices;
  sigevent event_{};
  unsigned due_ = 0;  ///< threads that are to be started
  Notice* next_ = nullptr;
};

/// Another process, or the system, may ring a notice, by the signal `bell` with its address: so much more, or less, of
/// them. Then the program is not at its end when no thread of its own can go on.
void expect_ring_from_outside(int by);
/// Whether a signal is such a ring, which was done.
bool ring_by_signal(const siginfo_t& information);
/// In a child: nothing is told of there.
void forget_notices();

}  // namespace waitpoint::posix
