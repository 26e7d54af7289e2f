// SPDX-License-Identifier: BSD-3-Clause
//
// sem_t: the program's object holds the count and a pointer to the waitable; if processes share it, a count of changes
// in place of the pointer.
#include <limits.h>
#include <semaphore.h>

#include <cerrno>
#include <cstring>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/sync/shared_object.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

struct Semaphore : Waitable {
  static constexpr Kind kind_of_all = Kind::semaphore;
  explicit Semaphore(const void* address) : Waitable(kind_of_all, "semaphore", address) {}
};

struct Bytes : SharedBytes<Semaphore> {
  std::uint32_t count;
  std::uint32_t changes;
};
static_assert(sizeof(Bytes) <= sizeof(sem_t));
static_assert(SEM_VALUE_MAX <= INT_MAX, "sem_getvalue() tells the count as an int");

Bytes& bytes_of(sem_t* semaphore) { return *reinterpret_cast<Bytes*>(semaphore); }

bool take_one(Bytes& bytes, std::uint32_t& changes) {
  changes = bytes.changes;
  if (bytes.count == 0) return false;
  --bytes.count;
  return true;
}

int acquire_before(sem_t* semaphore, Time deadline, bool is_valid_deadline) {
  if (!is_simulated()) refuse("a thread waits before main() begins");
  if (!is_valid_deadline) return fail(EINVAL);
  Bytes& bytes = bytes_of(semaphore);
  bytes.check("waits for");
  Semaphore& known = bytes.waitable();
  const CancellationPoint point;
  pass(kernel::Operation::acquire, &known.object);
  for (std::uint32_t changes = 0;;) {
    if (take_one(bytes, changes)) return 0;
    if (deadline <= kernel::running->local_time) return fail(ETIMEDOUT);
    Wait ended = Wait::interrupted;
    if (!bytes.is_shared())
      ended = point.block(known.object, deadline);
    else if (!point.was_cancelled())
      ended = wait_for_change(known.object, bytes.changes, changes, deadline);
    if (ended == Wait::came && !bytes.is_shared()) return 0;
    if (point.was_cancelled()) leave_if_cancelled();
    if (ended == Wait::timed_out) return fail(ETIMEDOUT);
    if (ended == Wait::interrupted && is_interrupted(Restart::if_asked)) return fail(EINTR);
  }
}

int give_shared(Bytes& bytes, Semaphore& known) {
  if (bytes.count == SEM_VALUE_MAX) return fail(EOVERFLOW);
  ++bytes.count;
  ++bytes.changes;
  tell_change(known.object);
  return 0;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sem_init(sem_t* semaphore, int shared, unsigned count) noexcept {
  if (count > SEM_VALUE_MAX) return fail(EINVAL);
  std::memset(semaphore, 0, sizeof *semaphore);
  bytes_of(semaphore).mark = shared != 0 ? mark_of_shared : 0;
  bytes_of(semaphore).count = count;
  return 0;
}

WAITPOINT_INTERPOSED int sem_destroy(sem_t* semaphore) noexcept {
  bytes_of(semaphore).destroy(Waitable::Kind::semaphore);
  return 0;
}

WAITPOINT_INTERPOSED int sem_post(sem_t* semaphore) noexcept {
  Bytes& bytes = bytes_of(semaphore);
  bytes.check("posts");
  Semaphore& known = bytes.waitable();
  if (is_simulated()) pass(kernel::Operation::release, &known.object);
  if (bytes.is_shared()) return give_shared(bytes, known);
  if (is_simulated() && wake_one(known.object) != nullptr) return 0;
  if (bytes.count == SEM_VALUE_MAX) return fail(EOVERFLOW);
  ++bytes.count;
  return 0;
}

WAITPOINT_INTERPOSED int sem_trywait(sem_t* semaphore) noexcept {
  Bytes& bytes = bytes_of(semaphore);
  if (is_simulated()) pass(kernel::Operation::try_acquire, &bytes.waitable().object);
  std::uint32_t changes = 0;
  return take_one(bytes, changes) ? 0 : fail(EAGAIN);
}

WAITPOINT_INTERPOSED int sem_getvalue(sem_t* __restrict semaphore, int* __restrict count) noexcept {
  if (are_calls_events()) pass(kernel::Operation::load, &bytes_of(semaphore).waitable().object);
  *count = static_cast<int>(bytes_of(semaphore).count);
  return 0;
}

WAITPOINT_INTERPOSED int sem_wait(sem_t* semaphore) { return acquire_before(semaphore, Time::max(), true); }

WAITPOINT_INTERPOSED int sem_clockwait(sem_t* semaphore, clockid_t clock, const timespec* deadline) {
  if (!is_clock_of_deadlines(clock)) return fail(EINVAL);
  return acquire_before(semaphore, when(clock, *deadline), is_valid(*deadline));
}

WAITPOINT_INTERPOSED int sem_timedwait(sem_t* __restrict semaphore, const timespec* __restrict deadline) {
  return sem_clockwait(semaphore, CLOCK_REALTIME, deadline);
}
