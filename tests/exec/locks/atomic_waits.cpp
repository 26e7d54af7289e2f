// SPDX-License-Identifier: BSD-3-Clause
//
// locks CASE [safe]: a lost update, a lost wake-up and crossed locks of atomics with wait() and notify_one(); correct
// with a second word.
#include <atomic>
#include <cstring>
#include <thread>

namespace {

// A lock by waiting and notifying.
class Lock {
 public:
  void take() {
    while (is_taken_.exchange(1) != 0) is_taken_.wait(1);
  }
  void give() {
    is_taken_.store(0);
    is_taken_.notify_one();
  }

 private:
  std::atomic<int> is_taken_ = 0;
};

Lock one, two;
std::atomic<int> balance = 0, ready = 0;
bool is_safe = false;

void add() {
  if (is_safe)
    ++balance;
  else
    balance = balance + 1;
}

void give() {
  if (is_safe) ready = 1;
  ready.notify_one();
  ready = 1;
}

void take_both(Lock& first, Lock& second) {
  first.take();
  second.take();
  ++balance;
  second.give();
  first.give();
}

}  // namespace

int main(int count, char** words) {
  is_safe = count > 2;
  const bool updates = std::strcmp(words[1], "update") == 0, wakes = std::strcmp(words[1], "wake-up") == 0;
  std::thread other([&] { updates ? add() : wakes ? give() : take_both(one, two); });
  updates ? add() : wakes ? ready.wait(0) : is_safe ? take_both(one, two) : take_both(two, one);
  other.join();
  return wakes || balance == 2 ? 0 : 1;
}
