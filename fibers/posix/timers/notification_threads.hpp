// SPDX-License-Identifier: BSD-3-Clause
// Notification threads: SIGEV_THREAD, of timers, message queues and asynchronous input and output. As in the C library,
// a thread of the layer starts them; all of these begin with all signals blocked.
#pragma once

#include <pthread.h>
#include <signal.h>

namespace waitpoint::posix {

struct Program;

/// Starts a thread of the layer; false without memory.
bool start_blocking_signals(void* (*start)(void*), void* argument, const pthread_attr_t* attributes);

/// Starts a notification thread from the running one.
void start_notification(const sigevent& event);

/// A source of notifications: each ring() starts a thread.
class Notice {
 public:
  Notice();
  ~Notice();
  Notice(const Notice&) = delete;
  Notice& operator=(const Notice&) = delete;

  /// Sets the program's event; false without memory.
  bool prepare(const sigevent& event);
  /// Callable from an event, too.
  void ring();

 private:
  friend struct Notices;
  sigevent event_{};
  Program* program_ = nullptr;  ///< of its threads
  unsigned due_ = 0;            ///< threads to be started
  Notice* next_ = nullptr;
};

/// Changes the number of notices that another process or the system may ring, by the signal `bell` with the notice's
/// address. While there are any, the run does not end when none of its threads can continue.
void expect_ring_from_outside(int by);
/// If a signal is such a ring, rings the notice and returns true.
bool ring_by_signal(const siginfo_t& information);

}  // namespace waitpoint::posix
