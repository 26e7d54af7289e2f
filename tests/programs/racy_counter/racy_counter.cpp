// SPDX-License-Identifier: BSD-3-Clause
// Two threads and a counter without a lock, to be built with waitpoint-races: racy_counter locked|unlocked. Its race is
// found in every schedule.
#include <iostream>
#include <mutex>
#include <string>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

namespace threads = waitpoint::threads;

int counter;

int main(int argc, char** argv) {
  const bool locked = argc > 1 && std::string(argv[1]) == "locked";
  const auto body = [locked] {
    counter = 0;
    threads::mutex door;
    const auto count = [&] {
      std::unique_lock lock(door, std::defer_lock);
      if (locked) lock.lock();
      counter = counter + 1;
    };
    threads::thread one({.name = "one"}, count), two({.name = "two"}, count);
    one.join();
    two.join();
    waitpoint::check(counter == 2, "an increment is lost");
  };
  const waitpoint::ExploreReport report = waitpoint::explore(body, {.iterations = 300});
  std::cout << report << "\n";
  return report.passed ? 0 : 1;
}
