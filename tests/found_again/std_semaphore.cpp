// SPDX-License-Identifier: BSD-3-Clause
// GCC, bug 104928: two threads take turns by a semaphore of the standard library.
#include <semaphore>
#include <thread>

int main() {
  std::binary_semaphore turn(1);
  const auto take_turn = [&] {
    turn.acquire();
    turn.release();
  };
  std::thread other(take_turn);
  take_turn();
  other.join();
}
