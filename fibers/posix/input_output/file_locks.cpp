// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/file_locks.hpp"

#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"

namespace waitpoint::posix {
namespace {

/// A lock that a waiting thread tries to take repeatedly.
struct Locking {
  int descriptor;
  int operation;             ///< of flock(), or a command of fcntl()
  const struct flock* lock;  ///< null: it is flock()'s
  int result, error;
};

// The system reports deadlocks among processes that wait for locks; it does not know that ours wait.
bool closes_a_cycle(const Locking& locking) {
  if (locking.operation != F_SETLK) return false;
  struct flock holder = *locking.lock;
  if (WAITPOINT_NEXT(fcntl)(locking.descriptor, F_GETLK, &holder) != 0 || holder.l_type == F_UNLCK) return false;
  const family::Process* const process = family::find_in_system(holder.l_pid);
  return process != nullptr && !family::note_waiting_for(process->id);
}

bool try_lock(const void* what) {
  auto& locking = *static_cast<Locking*>(const_cast<void*>(what));
  WAITPOINT_CHECK(locking.lock != nullptr ? locking.operation == F_SETLK || locking.operation == F_OFD_SETLK
                                          : (locking.operation & LOCK_NB) != 0,
                  "a lock is tried by a call that blocks the process");
  const ErrorNumberKept kept;
  locking.result = locking.lock != nullptr ? WAITPOINT_NEXT(fcntl)(locking.descriptor, locking.operation, locking.lock)
                                           : WAITPOINT_NEXT(flock)(locking.descriptor, locking.operation);
  locking.error = errno;
  if (locking.result == 0 || (locking.error != EAGAIN && locking.error != EACCES)) return true;
  if (locking.lock == nullptr || !closes_a_cycle(locking)) return false;
  locking.error = EDEADLK;
  return true;
}

int wait_for_lock(Locking locking) {
  if (wait_outside(try_lock, &locking, Restart::if_asked) > 0) return locking.result == 0 ? 0 : fail(locking.error);
  return -1;
}

}  // namespace

int lock_waiting(int descriptor, int command, const struct flock& lock) {
  const CancellationPoint point;
  const AlsoUsing locks(reading(place::descriptors) | changing(place::file_locks));
  pass(lock.l_type == F_UNLCK ? kernel::Operation::unlock : kernel::Operation::lock, nullptr);
  const int result = wait_for_lock({descriptor, command == F_SETLKW ? F_SETLK : F_OFD_SETLK, &lock, 0, 0});
  const ErrorNumberKept kept;
  family::note_waiting_for(0);
  if (result != 0) leave_if_cancelled();
  return result;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int flock(int descriptor, int operation) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(flock)(descriptor, operation);
  const AlsoUsing locks(reading(place::descriptors) | changing(place::file_locks));
  pass((operation & LOCK_UN) != 0 ? kernel::Operation::unlock : kernel::Operation::lock, nullptr);
  if ((operation & (LOCK_NB | LOCK_UN)) != 0) return WAITPOINT_NEXT(flock)(descriptor, operation);
  return wait_for_lock({descriptor, operation | LOCK_NB, nullptr, 0, 0});
}

WAITPOINT_INTERPOSED int lockf64(int descriptor, int command, off64_t size) {
  if (!is_simulated() || command != F_LOCK) return WAITPOINT_NEXT(lockf64)(descriptor, command, size);
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_CUR;
  lock.l_len = size;
  return lock_waiting(descriptor, F_SETLKW, lock);
}
extern "C" [[gnu::visibility("default"), gnu::alias("lockf64")]] int waitpoint_lockf(int descriptor, int command,
                                                                                     off64_t size) __asm__("lockf");
