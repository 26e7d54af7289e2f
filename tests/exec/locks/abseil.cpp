// SPDX-License-Identifier: BSD-3-Clause
//
// locks CASE [safe]: a lost update, a lost wake-up and crossed locks with Abseil's mutexes; correct with a second word.
#include <absl/synchronization/mutex.h>

#include <cstring>
#include <thread>

namespace {

absl::Mutex one, two;
absl::CondVar changed;
int balance = 0;
bool ready = false, is_safe = false;

void add() {
  one.Lock();
  const int seen = balance;
  if (!is_safe) {
    one.Unlock();
    one.Lock();
  }
  balance = seen + 1;
  one.Unlock();
}

void give() {
  const absl::MutexLock locked(&one);
  ready = true;
  changed.Signal();
}

void await_ready() {
  one.Lock();
  if (is_safe) {
    while (!ready) changed.Wait(&one);
  } else if (!ready) {
    one.Unlock();
    one.Lock();
    changed.Wait(&one);
  }
  one.Unlock();
}

void take_both(absl::Mutex& first, absl::Mutex& second) {
  const absl::MutexLock first_locked(&first), second_locked(&second);
  ++balance;
}

}  // namespace

int main(int count, char** words) {
  is_safe = count > 2;
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  const bool updates = std::strcmp(words[1], "update") == 0, wakes = std::strcmp(words[1], "wake-up") == 0;
  std::thread other([&] { updates ? add() : wakes ? give() : take_both(one, two); });
  updates ? add() : wakes ? await_ready() : is_safe ? take_both(one, two) : take_both(two, one);
  other.join();
  return wakes || balance == 2 ? 0 : 1;
}
