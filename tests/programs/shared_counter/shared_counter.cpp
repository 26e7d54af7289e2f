// SPDX-License-Identifier: BSD-3-Clause
// Two threads and a counter, to be built with a sanitizer: shared_counter locked|unlocked|beyond. Unlocked it is a data
// race, though the simulation runs both threads in one; beyond its end it is an overflow of a thread's stack.
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <waitpoint/fibers/sync/simulation.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

namespace threads = waitpoint::threads;

int main(int argc, char** argv) {
  const std::string how = argc > 1 ? argv[1] : "locked";
  const waitpoint::Report report = waitpoint::simulate([&how] {
    threads::mutex door;
    int counter[2] = {};
    const auto count = [&] {
      for (int i = 0; i < 3; ++i) {
        std::unique_lock lock(door, std::defer_lock);
        if (how != "unlocked") lock.lock();
        ++counter[how == "beyond" ? 2 : 1];
        threads::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    };
    threads::thread one({.name = "one"}, count), two({.name = "two"}, count);
    one.join();
    two.join();
    std::printf("counted to %d\n", counter[1]);
  });
  return report.passed ? 0 : 1;
}
