// SPDX-License-Identifier: BSD-3-Clause
// Two threads and a counter without a lock, to be built with waitpoint-races: racy_counter locked|unlocked. Its races
// are found in whatever schedule; that an increment is lost takes a switch between a read and a write.
#include <iostream>
#include <mutex>
#include <string>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/explore/races/races.hpp>
#include <waitpoint/fibers/sync/simulation.hpp>
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
  (void)waitpoint::simulate(body);
  const auto races = waitpoint::races::found();
  for (const waitpoint::races::Race& race : races) std::cout << race;
  const waitpoint::ExploreReport report = waitpoint::explore(body, {.iterations = 300});
  std::cout << (report.passed ? "no schedule fails" : "a schedule fails") << "\n";
  return races.empty() && report.passed ? 0 : 1;
}
