// SPDX-License-Identifier: BSD-3-Clause
// GCC, bug 104928: three threads take turns by a semaphore of the standard library.
#include <semaphore>
#include <thread>

int main() {
  std::binary_semaphore free(1);
  const auto take_turn = [&] {
    free.acquire();
    free.release();
  };
  std::thread second(take_turn);
  std::thread third(take_turn);
  take_turn();
  second.join();
  third.join();
}
