// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/futex_vectors.hpp"

#include <linux/futex.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint32_t most_at_once = 128;
constexpr std::uint32_t of_32_bits = 2;
static_assert(most_at_once == FUTEX_WAITV_MAX && of_32_bits == FUTEX_32);

/// A waiting thread, on its own stack.
struct Vector {
  kernel::Task* task;
  const futex_waitv* words;
  std::uint32_t count;
  int woken = -1;  ///< index of the word
  Vector* next = nullptr;
};
Vector* first = nullptr;

kernel::Object object{"futexes"};

const std::uint32_t* address_of(const futex_waitv& word) {
  return reinterpret_cast<const std::uint32_t*>(static_cast<std::uintptr_t>(word.uaddr));
}

// 0, or the error number of the system call.
int error_of(const futex_waitv* words, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!can_be_read(&words[i])) return EFAULT;
    if ((words[i].flags & ~std::uint32_t{FUTEX_PRIVATE_FLAG}) != of_32_bits || words[i].__reserved != 0) return EINVAL;
    if (words[i].uaddr % sizeof(std::uint32_t) != 0) return EINVAL;
    if (!can_be_read(address_of(words[i]))) return EFAULT;
  }
  return 0;
}

bool has_another_value(const Vector& vector) {
  for (std::uint32_t i = 0; i < vector.count; ++i) {
    const futex_waitv& word = vector.words[i];
    if (__atomic_load_n(address_of(word), __ATOMIC_SEQ_CST) != static_cast<std::uint32_t>(word.val)) return true;
  }
  return false;
}

void remove(const Vector& vector) {
  Vector** link = &first;
  while (*link != nullptr && *link != &vector) link = &(*link)->next;
  WAITPOINT_CHECK(*link != nullptr, "a thread that waits for several futexes is not in their list");
  *link = vector.next;
}

}  // namespace

long wait_for_any_futex(const CallWords& words) {
  const auto count = words.word<std::uint32_t>(1);
  const auto timeout = words.word<const timespec*>(3);
  const auto clock = words.word<clockid_t>(4);
  const auto list = words.word<const futex_waitv*>(0);
  if (words.at[2] != 0 || count == 0 || count > most_at_once || list == nullptr) return fail(EINVAL);
  if (timeout != nullptr) {
    if (clock != CLOCK_REALTIME && clock != CLOCK_MONOTONIC) return fail(EINVAL);
    if (!can_be_read(timeout)) return fail(EFAULT);
    if (!is_valid(*timeout) || timeout->tv_sec < 0) return fail(EINVAL);
  }
  if (const int error = error_of(list, count); error != 0) return fail(error);
  const Time deadline = timeout == nullptr ? Time::max() : when(clock, *timeout);
  kernel::enter(object);
  pass(kernel::Operation::wait, &object);
  for (;;) {
    Vector vector{kernel::running, list, count, -1, first};
    if (has_another_value(vector)) return fail(EAGAIN);
    if (deadline <= kernel::running->local_time) return fail(ETIMEDOUT);
    first = &vector;
    const Wait ended = wait_on(object, deadline);
    remove(vector);
    if (vector.woken >= 0) return vector.woken;
    if (ended == Wait::timed_out) return fail(ETIMEDOUT);
    if (is_interrupted(Restart::if_asked)) return fail(EINTR);
  }
}

std::uint32_t wake_vectors(const void* address, std::uint32_t most) {
  std::uint32_t woken = 0;
  for (Vector* vector = first; vector != nullptr && woken < most; vector = vector->next)
    for (std::uint32_t i = 0; i < vector->count && vector->woken < 0; ++i) {
      if (address_of(vector->words[i]) != address) continue;
      WAITPOINT_FAST_CHECK(vector->task->state != kernel::TaskState::blocked || vector->task->blocked_on == &object,
                           "a thread that waits for several futexes is blocked on something else");
      vector->woken = static_cast<int>(i);
      if (vector->task->state == kernel::TaskState::blocked) kernel::wake(*vector->task->scheduler, *vector->task);
      ++woken;
    }
  return woken;
}

void forget_vectors() { first = nullptr; }

void forget_vector(const kernel::Task& task) {
  for (const Vector* vector = first; vector != nullptr; vector = vector->next)
    if (vector->task == &task) return remove(*vector);
}

}  // namespace waitpoint::posix
