// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_barrier_t: the counts are kept in the program's object.
#include <limits.h>
#include <pthread.h>

#include <cerrno>
#include <cstring>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/sync/shared_object.hpp"

namespace waitpoint::posix {
namespace {

struct Barrier : Waitable {
  static constexpr Kind kind_of_all = Kind::barrier;
  explicit Barrier(const void* address) : Waitable(kind_of_all, "barrier", address) {}
};

struct Bytes : SharedBytes<Barrier> {
  unsigned count, arrived;
  std::uint32_t opened;  // number of completed rounds
};
static_assert(sizeof(Bytes) <= sizeof(pthread_barrier_t));

Bytes& bytes_of(pthread_barrier_t* barrier) { return *reinterpret_cast<Bytes*>(barrier); }

// True for the last thread of a round.
bool arrive(Bytes& bytes, std::uint32_t& opened) {
  opened = bytes.opened;
  if (++bytes.arrived < bytes.count) return false;
  bytes.arrived = 0;
  ++bytes.opened;
  return true;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_barrier_init(pthread_barrier_t* barrier, const pthread_barrierattr_t* attributes,
                                              unsigned count) noexcept {
  if (count == 0 || count > INT_MAX) return EINVAL;
  int sharing = PTHREAD_PROCESS_PRIVATE;
  if (attributes != nullptr) pthread_barrierattr_getpshared(attributes, &sharing);
  std::memset(barrier, 0, sizeof *barrier);
  Bytes& bytes = bytes_of(barrier);
  bytes.count = count;
  if (sharing == PTHREAD_PROCESS_SHARED) bytes.mark = mark_of_shared;
  // An object that was at this address before may still have waiters.
  if (!bytes.is_shared()) bytes.known = &make_waitable<Barrier>(barrier);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_barrier_destroy(pthread_barrier_t* barrier) noexcept {
  Bytes& bytes = bytes_of(barrier);
  if (!bytes.is_shared() && bytes.known != nullptr && !bytes.known->idle())
    note_misuse("destroys", *bytes.known, ", awaited by ", bytes.known->object.first_waiter);
  if (bytes.arrived > 0) return EBUSY;
  const Waitable* const known = bytes.is_shared() ? find_waitable(barrier, Waitable::Kind::barrier) : bytes.known;
  if (known != nullptr && !known->idle()) return EBUSY;
  bytes.destroy(Waitable::Kind::barrier);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_barrier_wait(pthread_barrier_t* barrier) noexcept {
  if (!is_simulated()) refuse("a thread waits before main() begins");
  Bytes& bytes = bytes_of(barrier);
  bytes.check("waits for");
  Barrier& known = bytes.waitable();
  pass(kernel::Operation::arrive, &known.object);
  std::uint32_t opened = 0;
  if (arrive(bytes, opened)) {
    if (bytes.is_shared())
      tell_change(known.object);
    else
      kernel::wake_all(*kernel::running->scheduler, known.object);
    return PTHREAD_BARRIER_SERIAL_THREAD;
  }
  for (;;) {
    const Wait ended = bytes.is_shared() ? wait_for_change(known.object, bytes.opened, opened, Time::max())
                                         : wait_on(known.object, Time::max());
    if (ended == Wait::interrupted) handle_signals();
    if (__atomic_load_n(&bytes.opened, __ATOMIC_SEQ_CST) != opened) return 0;
  }
}
