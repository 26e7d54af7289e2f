// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_barrier_t: a word in its bytes leads to its count.
#include <pthread.h>

#include <cerrno>

#include "fibers/posix/interposed.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/signals.hpp"
#include "fibers/posix/waitable.hpp"
#include "fibers/posix/waiting.hpp"

namespace waitpoint::posix {
namespace {

struct Barrier : Waitable {
  static constexpr Kind kind_of_all = Kind::barrier;
  explicit Barrier(const void* address) : Waitable(kind_of_all, "barrier", address) {}

  unsigned count = 0, arrived = 0;
  std::uint64_t opened = 0;  ///< how often all had arrived
};

Barrier*& known_of(pthread_barrier_t* barrier) { return *reinterpret_cast<Barrier**>(barrier); }

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_barrier_init(pthread_barrier_t* barrier, const pthread_barrierattr_t*,
                                              unsigned count) noexcept {
  if (count == 0) return EINVAL;
  known_of(barrier) = &make_waitable<Barrier>(barrier);
  known_of(barrier)->count = count;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_barrier_destroy(pthread_barrier_t* barrier) noexcept {
  Barrier* const known = known_of(barrier);
  if (!known->idle()) return EBUSY;
  forget(*known);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_barrier_wait(pthread_barrier_t* barrier) noexcept {
  if (!is_simulated()) refuse("a thread waits before main() begins");
  Barrier& known = *known_of(barrier);
  pass(kernel::Operation::arrive, &known.object);
  if (++known.arrived < known.count) {
    const std::uint64_t opened = known.opened;
    while (wait_on(known.object, Time::max()) == Wait::interrupted) {
      handle_signals();
      if (known.opened != opened) break;
    }
    return 0;
  }
  known.arrived = 0;
  ++known.opened;
  kernel::running->scheduler->wake_all(known.object);
  return PTHREAD_BARRIER_SERIAL_THREAD;
}
