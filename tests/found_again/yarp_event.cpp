// SPDX-License-Identifier: BSD-3-Clause
// YARP (docs/found.md): an event that resets itself is signalled while a thread begins to wait for it.
#include <unistd.h>
#include <yarp/os/Event.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

int main() {
  yarp::os::Event event;
  std::atomic<int> waits = 0;
  std::thread waiter([&] {
    event.wait();
    ++waits;
    event.wait();
    ++waits;
  });
  event.signal();
  sleep(1);
  const int of_one_signal = waits;
  event.signal();
  waiter.join();
  if (of_one_signal == 1) return 0;
  std::fprintf(stderr, "one signal ended %d waits\n", of_one_signal);
  return EXIT_FAILURE;
}
