// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/futex.hpp"

#include <linux/futex.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/program/word.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/futex_owners.hpp"
#include "fibers/posix/sync/futex_vectors.hpp"
#include "fibers/posix/sync/shared_futexes.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {
namespace {

/// The threads that wait at a word: of this process, or of all processes of the family.
enum class Of : bool { process, family };

// Blocks the running thread; other processes may wake it.
Wait wait_at(Word& word, Time deadline) {
  const Thread& thread = this_thread();
  if (thread.shared_futex == nullptr) return wait_on(word.object, deadline);
  for (;;) {
    const Wait ended = wait_on_shared(word.object, deadline, has_woken, &thread.shared_futex);
    // Another thread of this process may have taken the wake-up from another process first.
    if (ended != Wait::came || thread.futex_mask == 0 || has_woken(&thread.shared_futex)) return ended;
  }
}

long wait(std::uint32_t* address, std::uint32_t expected, Time deadline, std::uint32_t mask, Of of) {
  if (mask == 0) return fail(EINVAL);
  if (!is_simulated()) refuse("a thread waits before main() begins");
  family::note_own_futexes();
  Word& word = word_at(address);
  pass(kernel::Operation::wait, &word.object);
  for (;;) {
    Thread& thread = this_thread();
    WAITPOINT_CHECK(thread.shared_futex == nullptr, "a thread that waits at a shared futex begins another wait");
    thread.shared_futex = of == Of::family ? begin_to_wait(address) : nullptr;
    const bool is_other = __atomic_load_n(address, __ATOMIC_SEQ_CST) != expected;
    kernel::sanitizer::read(address, sizeof *address);
    thread.futex_mask = mask;
    Wait ended = Wait::timed_out;
    if (!is_other && deadline > kernel::running->local_time) ended = wait_at(word, deadline);
    if (SharedFutex* const shared = thread.shared_futex; shared != nullptr) {
      thread.shared_futex = nullptr;
      if (end_waiting(*shared, thread.futex_mask == 0)) ended = Wait::came;
    }
    if (is_other && ended != Wait::came) return fail(EAGAIN);
    if (ended != Wait::interrupted) return ended == Wait::came ? 0 : fail(ETIMEDOUT);
    if (is_interrupted(deadline == Time::max() ? Restart::if_asked : Restart::never)) return fail(EINTR);
  }
}

// A zero mask tells a thread that its own process woke it.
void note_woken(const kernel::Task& task) {
  WAITPOINT_FAST_CHECK(is_thread(task), "a task that is no thread waited at a futex");
  thread_of(task).futex_mask = 0;
}

std::uint32_t count_waiters(const Word& word) {
  std::uint32_t count = 0;
  for (const kernel::Task* task = word.object.first_waiter; task != nullptr; task = task->next_waiter) ++count;
  return count;
}

long wake(std::uint32_t* address, std::uint32_t most, std::uint32_t mask, Of of) {
  if (mask == 0) return fail(EINVAL);
  if (!is_simulated()) return 0;
  family::note_own_futexes();
  Word& word = word_at(address);
  pass(kernel::Operation::notify_one, &word.object);
  const std::uint32_t own = of == Of::family ? count_waiters(word) : 0;
  long woken = 0;
  if (mask == FUTEX_BITSET_MATCH_ANY) {
    for (kernel::Task* task = nullptr; woken < most && (task = wake_one(word.object)) != nullptr; ++woken)
      note_woken(*task);
    if (woken < most) woken += wake_vectors(address, most - static_cast<std::uint32_t>(woken));
    if (of == Of::family && woken < most) woken += wake_others(address, most - static_cast<std::uint32_t>(woken), own);
    return woken;
  }
  for (kernel::Task *task = word.object.first_waiter, *next = nullptr; task != nullptr && woken < most; task = next) {
    next = task->next_waiter;
    if ((thread_of(*task).futex_mask & mask) == 0) continue;
    kernel::wake(*kernel::running->scheduler, *task);
    note_woken(*task);
    ++woken;
  }
  return woken;
}

// Wakes some waiters and moves at most `most_moved` of the others to another address. Returns the number of threads
// woken or moved.
long requeue(std::uint32_t* from, std::uint32_t most_woken, std::uint32_t most_moved, std::uint32_t* to) {
  long count = wake(from, most_woken, FUTEX_BITSET_MATCH_ANY, Of::process);
  if (count < 0 || from == to) return count;
  kernel::Object& target = word_at(to).object;
  kernel::enter(target);
  WAITPOINT_CHECK(target.owner == nullptr && word_at(from).object.owner == nullptr,
                  "waiters are moved between futexes that have an owner");
  for (kernel::Task* task = word_at(from).object.first_waiter; task != nullptr && most_moved > 0; --most_moved) {
    kernel::Task* const next = task->next_waiter;
    kernel::move_waiter(*task, target);
    if (SharedFutex*& shared = thread_of(*task).shared_futex; shared != nullptr && !has_woken(&shared)) {
      end_waiting(*shared, true);
      shared = begin_to_wait(to);
    }
    task = next;
    ++count;
  }
  return count;
}

long operate_and_wake(std::uint32_t* first, std::uint32_t most, std::uint32_t most_second, std::uint32_t* second,
                      std::uint32_t code, Of of) {
  const std::uint32_t operation = code >> 28 & 7, comparison = code >> 24 & 15;
  std::uint32_t operand = code >> 12 & 0xFFF;
  const std::uint32_t compared = code & 0xFFF, old = *second;
  if ((operand & 0x800) != 0) operand |= 0xFFFFF000;  // a negative number of 12 bits
  if ((code >> 31) != 0) operand = 1U << (operand & 31);
  switch (operation) {
    case FUTEX_OP_SET: *second = operand; break;
    case FUTEX_OP_ADD: *second = old + operand; break;
    case FUTEX_OP_OR: *second = old | operand; break;
    case FUTEX_OP_ANDN: *second = old & ~operand; break;
    case FUTEX_OP_XOR: *second = old ^ operand; break;
    default: return fail(ENOSYS);
  }
  const auto a = static_cast<std::int32_t>(old), b = static_cast<std::int32_t>(compared);
  const bool holds[] = {a == b, a != b, a<b, a <= b, a> b, a >= b};
  if (comparison >= sizeof holds) return fail(ENOSYS);
  const long woken = wake(first, most, FUTEX_BITSET_MATCH_ANY, of);
  return holds[comparison] ? woken + wake(second, most_second, FUTEX_BITSET_MATCH_ANY, of) : woken;
}

}  // namespace

long futex(std::uint32_t* address, int operation, std::uint32_t value, const timespec* timeout, std::uint32_t* second,
           std::uint32_t third) {
  const clockid_t clock = (operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC;
  const auto count = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(timeout));
  const int what = operation & FUTEX_CMD_MASK;
  const Of of = (operation & FUTEX_PRIVATE_FLAG) != 0 ? Of::process : Of::family;
  const bool has_timeout =
      what == FUTEX_WAIT || what == FUTEX_WAIT_BITSET || what == FUTEX_LOCK_PI || what == FUTEX_LOCK_PI2;
  if (has_timeout && timeout != nullptr && (!is_valid(*timeout) || timeout->tv_sec < 0)) return fail(EINVAL);
  if (reinterpret_cast<std::uintptr_t>(address) % sizeof *address != 0) return fail(EINVAL);
  if (address == nullptr) return fail(what <= FUTEX_WAKE_BITSET ? EFAULT : ENOSYS);
  switch (what) {
    case FUTEX_WAIT:
      return wait(address, value,
                  timeout == nullptr ? Time::max() : later(kernel::local_time(*kernel::running), span(*timeout)),
                  FUTEX_BITSET_MATCH_ANY, of);
    case FUTEX_WAIT_BITSET:
      return wait(address, value, timeout == nullptr ? Time::max() : when(clock, *timeout), third, of);
    case FUTEX_WAKE: return wake(address, value, FUTEX_BITSET_MATCH_ANY, of);
    case FUTEX_WAKE_BITSET: return wake(address, value, third, of);
    case FUTEX_CMP_REQUEUE:
      if (__atomic_load_n(address, __ATOMIC_RELAXED) != third) return fail(EAGAIN);
      return requeue(address, value, count, second);
    case FUTEX_REQUEUE: return requeue(address, value, count, second);
    case FUTEX_WAKE_OP: return operate_and_wake(address, value, count, second, third, of);
    case FUTEX_LOCK_PI: return lock_owned(address, timeout == nullptr ? Time::max() : when(CLOCK_REALTIME, *timeout));
    case FUTEX_LOCK_PI2: return lock_owned(address, timeout == nullptr ? Time::max() : when(clock, *timeout));
    case FUTEX_TRYLOCK_PI: return try_lock_owned(address);
    case FUTEX_UNLOCK_PI: return unlock_owned(address);
    default: return fail(ENOSYS);
  }
}

}  // namespace waitpoint::posix
