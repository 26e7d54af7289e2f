// SPDX-License-Identifier: BSD-3-Clause
// The namespace of thread primitives for module code: simulated by default, real ones where WAITPOINT_REAL_THREADS is
// defined. The same source runs in simulation and on the robot.
//
//   waitpoint::threads::mutex m;                       // a fiber's mutex in virtual time, or std::mutex
//   waitpoint::threads::periodic_timer tick(Period::hertz(50));
//   waitpoint::threads::compute(300us);                // declares the cost of the code before it; no-op on the robot
#pragma once

#include "core/fields.hpp"
#include "core/time.hpp"

#ifdef WAITPOINT_REAL_THREADS
#include "fibers/sync/real_threads.hpp"
#else
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/barrier.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/fiber_local.hpp"
#include "fibers/sync/jthread.hpp"
#include "fibers/sync/latch.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/once.hpp"
#include "fibers/sync/packaged_task.hpp"
#include "fibers/sync/periodic_timer.hpp"
#include "fibers/sync/priority_mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/shared_mutex.hpp"

namespace waitpoint::threads {

using kernel::ClockKind;
using kernel::ClockOptions;
using kernel::LockProtocol;
using waitpoint::access_hardware;
using waitpoint::async;
using waitpoint::atomic;
using waitpoint::atomic_flag;
using waitpoint::atomic_signal_fence;
using waitpoint::atomic_thread_fence;
using waitpoint::barrier;
using waitpoint::binary_semaphore;
using waitpoint::call_once;
using waitpoint::compute;
using waitpoint::condition_variable;
using waitpoint::condition_variable_any;
using waitpoint::counting_semaphore;
using waitpoint::fiber_local;
using waitpoint::future;
using waitpoint::jthread;
using waitpoint::latch;
using waitpoint::launch;
using waitpoint::mutex;
using waitpoint::mutex_attributes;
using waitpoint::nostopstate;
using waitpoint::nostopstate_t;
using waitpoint::now;
using waitpoint::once_flag;
using waitpoint::packaged_task;
using waitpoint::periodic_timer;
using waitpoint::priority_mutex;
using waitpoint::processor;
using waitpoint::promise;
using waitpoint::recursive_mutex;
using waitpoint::recursive_timed_mutex;
using waitpoint::shared_future;
using waitpoint::shared_mutex;
using waitpoint::shared_timed_mutex;
using waitpoint::steady_clock;
using waitpoint::stop_callback;
using waitpoint::stop_source;
using waitpoint::stop_token;
using waitpoint::system_clock;
using waitpoint::thread;
using waitpoint::thread_attributes;
using waitpoint::timed_mutex;
namespace this_thread = waitpoint::this_thread;

/// Identifies the kind of threads: a parameter of this type makes linking with code compiled for the other kind fail.
struct simulated {};
using kind = simulated;

/// The lock of an observer outside the run that reads state protected by `mutex`. Here it is empty: no task runs
/// meanwhile, and reading makes no event. With real threads it locks the mutex.
struct observer_lock {
  explicit observer_lock(mutex&) {}
};

/// Adds an output of the caller (a poster, a message) to its robot's digest, by the value's declared fields.
template <class T>
void record(std::uint64_t name, const T& value) {
  Digest digest;
  add_value(digest, value);
  (void)sync::running_task();
  kernel::record_output(name, digest.value());
}

}  // namespace waitpoint::threads
#endif
