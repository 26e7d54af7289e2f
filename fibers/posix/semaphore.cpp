// SPDX-License-Identifier: BSD-3-Clause
//
// sem_t: a word in its bytes leads to its count. Named ones are known to this program alone.
#include <fcntl.h>
#include <limits.h>
#include <semaphore.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/cancellation.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/named_objects.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/signals.hpp"
#include "fibers/posix/waitable.hpp"

namespace waitpoint::posix {
namespace {

struct Semaphore : Waitable {
  static constexpr Kind kind_of_all = Kind::semaphore;
  explicit Semaphore(const void* address) : Waitable(kind_of_all, "semaphore", address) {}

  unsigned count = 0;
};

Semaphore& semaphore_of(sem_t* semaphore) { return waitable_at(*reinterpret_cast<Semaphore**>(semaphore), semaphore); }

int acquire_before(sem_t* semaphore, Time deadline, bool is_valid_deadline) {
  if (!is_simulated()) refuse("a thread waits before main() begins");
  Semaphore& known = semaphore_of(semaphore);
  const CancellationPoint point;
  pass(kernel::Operation::acquire, &known.object);
  for (;;) {
    if (known.count > 0) {
      --known.count;
      return 0;
    }
    if (!is_valid_deadline) return fail(EINVAL);
    if (deadline <= kernel::running->local_time) return fail(ETIMEDOUT);
    const Wait ended = point.block(known.object, deadline);
    if (point.was_cancelled()) leave_if_cancelled();
    if (ended == Wait::came) return 0;
    if (ended == Wait::timed_out) return fail(ETIMEDOUT);
    if (is_interrupted(Restart::if_asked)) return fail(EINTR);
  }
}

struct Named {
  char* name;
  sem_t semaphore;
  unsigned opened;  // more often than closed
  bool unlinked;
  Named* next;
};
Named* first_named = nullptr;

Named* find_named(const char* name) {
  Named* named = first_named;
  while (named != nullptr && (named->unlinked || std::strcmp(named->name, name) != 0)) named = named->next;
  return named;
}

void let_go(Named& named) {
  if (!named.unlinked || named.opened > 0) return;
  Named** link = &first_named;
  while (*link != &named) link = &(*link)->next;
  *link = named.next;
  sem_destroy(&named.semaphore);
  std::free(named.name);
  std::free(&named);
}

// As the files that glibc makes of them, "sem.NAME": a slash, which may be missing, and none behind it.
bool is_name(const char* name) {
  if (*name == '/') ++name;
  const std::size_t length = std::strlen(name);
  return length > 0 && length <= NAME_MAX - 4 && std::strchr(name, '/') == nullptr;
}

Named* make_named(const char* name, unsigned count) {
  auto* named = static_cast<Named*>(std::calloc(1, sizeof(Named)));
  char* copy = named != nullptr ? strdup(name) : nullptr;
  if (copy == nullptr) {
    std::free(named);
    return nullptr;
  }
  named->name = copy;
  sem_init(&named->semaphore, 0, count);
  named->next = first_named;
  return first_named = named;
}

}  // namespace

void forget_named_semaphores() {
  while (first_named != nullptr) {
    first_named->unlinked = true;
    first_named->opened = 0;
    let_go(*first_named);
  }
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sem_init(sem_t* semaphore, int, unsigned count) noexcept {
  if (count > SEM_VALUE_MAX) return fail(EINVAL);
  std::memset(semaphore, 0, sizeof *semaphore);
  semaphore_of(semaphore).count = count;
  return 0;
}

WAITPOINT_INTERPOSED int sem_destroy(sem_t* semaphore) noexcept {
  Semaphore*& known = *reinterpret_cast<Semaphore**>(semaphore);
  if (known != nullptr) forget(*known);
  known = nullptr;
  return 0;
}

WAITPOINT_INTERPOSED int sem_post(sem_t* semaphore) noexcept {
  Semaphore& known = semaphore_of(semaphore);
  if (is_simulated()) {
    pass(kernel::Operation::release, &known.object);
    if (wake_one(known.object) != nullptr) return 0;
  }
  if (known.count == SEM_VALUE_MAX) return fail(EOVERFLOW);
  ++known.count;
  return 0;
}

WAITPOINT_INTERPOSED int sem_trywait(sem_t* semaphore) noexcept {
  Semaphore& known = semaphore_of(semaphore);
  if (is_simulated()) pass(kernel::Operation::try_acquire, &known.object);
  if (known.count == 0) return fail(EAGAIN);
  --known.count;
  return 0;
}

WAITPOINT_INTERPOSED int sem_getvalue(sem_t* __restrict semaphore, int* __restrict count) noexcept {
  *count = static_cast<int>(semaphore_of(semaphore).count);
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

WAITPOINT_INTERPOSED sem_t* sem_open(const char* name, int flags, ...) noexcept {
  mode_t mode = 0;
  unsigned count = 0;
  if ((flags & O_CREAT) != 0) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    count = va_arg(more, unsigned);
    va_end(more);
  }
  (void)mode;
  errno = 0;
  Named* named = is_name(name) ? find_named(name) : nullptr;
  if (!is_name(name))
    errno = EINVAL;
  else if (named == nullptr && (flags & O_CREAT) == 0)
    errno = ENOENT;
  else if (named != nullptr && (flags & O_CREAT) != 0 && (flags & O_EXCL) != 0)
    errno = EEXIST;
  else if (named == nullptr && count > SEM_VALUE_MAX)
    errno = EINVAL;
  else if (named == nullptr && (named = make_named(name, count)) == nullptr)
    errno = ENOMEM;
  if (errno != 0) return SEM_FAILED;
  ++named->opened;
  return &named->semaphore;
}

WAITPOINT_INTERPOSED int sem_close(sem_t* semaphore) noexcept {
  for (Named* named = first_named; named != nullptr; named = named->next) {
    if (&named->semaphore != semaphore || named->opened == 0) continue;
    --named->opened;
    let_go(*named);
    return 0;
  }
  return fail(EINVAL);
}

WAITPOINT_INTERPOSED int sem_unlink(const char* name) noexcept {
  Named* const named = find_named(name);
  if (named == nullptr) return fail(ENOENT);
  named->unlinked = true;
  let_go(*named);
  return 0;
}
