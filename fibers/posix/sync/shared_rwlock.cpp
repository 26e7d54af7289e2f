// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/shared_rwlock.hpp"

#include <cerrno>
#include <cstddef>

#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/sync/shared_object.hpp"

namespace waitpoint::posix::shared_rwlock {
namespace {

// Laid over glibc's fields: `__shared` and the kind keep their places.
struct Bytes {
  void* unused;
  std::uint32_t readers;
  std::uint32_t changes;
  pid_t process;  // of the writer
  int thread;
  std::uint32_t waiting_writers;
  int shared;
  char between[16];
  unsigned kind;
};
static_assert(offsetof(Bytes, shared) == offsetof(pthread_rwlock_t, __data.__shared));
static_assert(offsetof(Bytes, kind) == offsetof(pthread_rwlock_t, __data.__flags));
static_assert(sizeof(Bytes) <= sizeof(pthread_rwlock_t));

Bytes& words_of(pthread_rwlock_t& bytes) { return reinterpret_cast<Bytes&>(bytes); }

bool is_mine(const Bytes& words) { return words.process == family::this_process() && words.thread == this_thread().id; }

// 0, an error, or -1 if it is held.
int try_to_read(Bytes& words, std::uint32_t& changes) {
  changes = words.changes;
  const bool writers_first = words.kind == PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP;
  if (words.process != 0 || (writers_first && words.waiting_writers > 0)) return -1;
  if (words.readers == UINT32_MAX) return EAGAIN;
  ++words.readers;
  return 0;
}

int try_to_write(Bytes& words, std::uint32_t& changes) {
  changes = words.changes;
  if (words.process != 0 || words.readers > 0) return -1;
  words.process = family::this_process();
  words.thread = this_thread().id;
  return 0;
}

// A count that falls is a change: readers may wait only because writers do.
void count_waiting_writer(Bytes& words, kernel::Object& object, int by) {
  words.waiting_writers += static_cast<std::uint32_t>(by);
  if (by < 0) ++words.changes;
  if (by < 0) tell_change(object);
}

}  // namespace

bool is_shared(const pthread_rwlock_t& bytes) { return bytes.__data.__shared != 0; }

int read_before(pthread_rwlock_t& bytes, kernel::Object& object, Time deadline, bool is_valid_deadline) {
  Bytes& words = words_of(bytes);
  if (is_mine(words)) return EDEADLK;
  for (std::uint32_t changes = 0;;) {
    if (const int result = try_to_read(words, changes); result >= 0) return result;
    if (!is_valid_deadline) return EINVAL;
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    const Wait ended = wait_for_change(object, words.changes, changes, deadline);
    if (ended == Wait::timed_out) return ETIMEDOUT;
    if (ended == Wait::interrupted) handle_signals();
  }
}

int write_before(pthread_rwlock_t& bytes, kernel::Object& object, Time deadline, bool is_valid_deadline) {
  Bytes& words = words_of(bytes);
  if (is_mine(words)) return EDEADLK;
  for (std::uint32_t changes = 0;;) {
    if (try_to_write(words, changes) == 0) return 0;
    if (!is_valid_deadline) return EINVAL;
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    count_waiting_writer(words, object, 1);
    const Wait ended = wait_for_change(object, words.changes, changes, deadline);
    count_waiting_writer(words, object, -1);
    if (ended == Wait::timed_out) return ETIMEDOUT;
    if (ended == Wait::interrupted) handle_signals();
  }
}

int unlock(pthread_rwlock_t& bytes, kernel::Object& object) {
  Bytes& words = words_of(bytes);
  if (words.process != 0)
    words.process = words.thread = 0;
  else if (words.readers > 0)
    --words.readers;
  ++words.changes;
  tell_change(object);
  return 0;
}

}  // namespace waitpoint::posix::shared_rwlock
