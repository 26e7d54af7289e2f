// SPDX-License-Identifier: BSD-3-Clause
// A program whose schedules are explored; in some of them it dies by the signal in its argument.
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/sync/atomic.hpp>
#include <waitpoint/fibers/sync/thread.hpp>

int main(int, char** argv) {
  const auto report = waitpoint::explore([&] {
    waitpoint::atomic<int> count{0};
    const auto increment = [&] {
      const int seen = count.load();
      count.store(seen + 1);
    };
    waitpoint::thread one(increment), two(increment);
    one.join();
    two.join();
    if (count.load() == 1) raise(std::atoi(argv[1]));
  });
  std::cout << report << "\n";
  return report.passed ? 0 : 1;
}
