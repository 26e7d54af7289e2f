// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_once_t, as glibc's: 0 not done, 2 done, and between them 1.
#include <pthread.h>
#include <threads.h>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/program/word.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {
namespace {

constexpr int fresh = 0, under_way = 1, done = 2;
static_assert(PTHREAD_ONCE_INIT == fresh);
static_assert(sizeof(pthread_once_t) == sizeof(int) && sizeof(once_flag) == sizeof(int) &&
              alignof(once_flag) == alignof(int));

void end(int* flag, int state) {
  if (!is_simulated()) {
    *flag = state;
    return;
  }
  Word& word = word_at(flag);
  if (kernel::sanitizer::present) kernel::sanitizer::release(&word.object);
  *flag = state;
  pass(kernel::Operation::release, &word.object);
  kernel::wake_all(*kernel::running->scheduler, word.object);
}

// A function that is left by an exception or a cancellation does not count as called: another thread calls it again.
struct Attempt {
  ~Attempt() { end(flag, completed ? done : fresh); }
  int* flag;
  bool completed = false;
};

int call(int* flag, void (*function)()) {
  while (*flag != done) {
    if (is_simulated()) {
      Word& word = word_at(flag);
      pass(kernel::Operation::call_once, &word.object);
      if (*flag == under_way) {
        block(word.object, Time::max());
        continue;
      }
      if (*flag == done) break;
    }
    *flag = under_way;
    Attempt attempt{flag};
    function();
    attempt.completed = true;
  }
  // A thread that finds it done has passed no waitpoint, so the happens-before edge is reported here.
  if (kernel::sanitizer::present && is_simulated()) kernel::sanitizer::acquire(&word_at(flag).object);
  return 0;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_once(pthread_once_t* once, void (*function)()) { return call(once, function); }
WAITPOINT_INTERPOSED int __pthread_once(pthread_once_t* once, void (*function)()) { return call(once, function); }
WAITPOINT_INTERPOSED void call_once(once_flag* flag, void (*function)()) {
  call(reinterpret_cast<int*>(flag), function);
}
