// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/futex_owners.hpp"

#include <linux/futex.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/program/word.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

std::uint32_t id_of(const Thread& thread) {
  const auto id = static_cast<std::uint32_t>(thread.id);
  WAITPOINT_CHECK(id != 0 && (id & FUTEX_TID_MASK) == id, "a thread's number does not fit into a futex");
  return id;
}
std::uint32_t own_id() { return id_of(this_thread()); }
std::uint32_t owner_of(const std::uint32_t* address) {
  return __atomic_load_n(address, __ATOMIC_SEQ_CST) & FUTEX_TID_MASK;
}

void give(std::uint32_t* address, std::uint32_t id, const Word& word) {
  __atomic_store_n(address, word.object.first_waiter != nullptr ? id | FUTEX_WAITERS : id, __ATOMIC_SEQ_CST);
}

// True if the word was free, and is taken now. Else `error` is 0 if waiting is allowed, or an error number.
bool take(std::uint32_t* address, const Word& word, int& error) {
  const std::uint32_t owner = owner_of(address);
  error = owner == own_id() ? EDEADLK : owner != 0 && thread_with_id(static_cast<int>(owner)) == nullptr ? ESRCH : 0;
  if (owner == 0) give(address, own_id(), word);
  return owner == 0;
}

}  // namespace

long lock_owned(std::uint32_t* address, Time deadline) {
  Word& word = word_at(address);
  pass(kernel::Operation::lock, &word.object);
  int error = 0;
  while (!take(address, word, error)) {
    if (error != 0) return fail(error);
    if (deadline <= kernel::running->local_time) return fail(ETIMEDOUT);
    __atomic_fetch_or(address, FUTEX_WAITERS, __ATOMIC_SEQ_CST);
    const Wait ended = wait_on(word.object, deadline);
    if (owner_of(address) == own_id()) return 0;  // handed over by the previous owner
    if (ended == Wait::interrupted) handle_signals();
  }
  return 0;
}

long try_lock_owned(std::uint32_t* address) {
  Word& word = word_at(address);
  pass(kernel::Operation::lock, &word.object);
  int error = 0;
  return take(address, word, error) ? 0 : fail(error != 0 ? error : EAGAIN);
}

long unlock_owned(std::uint32_t* address) {
  Word& word = word_at(address);
  pass(kernel::Operation::unlock, &word.object);
  if (owner_of(address) != own_id()) return fail(EPERM);
  const kernel::Task* const next = wake_one(word.object);
  give(address, next != nullptr ? id_of(thread_of(*next)) : 0, word);
  return 0;
}

}  // namespace waitpoint::posix
