// SPDX-License-Identifier: BSD-3-Clause
// Threads for tests of the debugger: clock_makers [HANDS [restless]]. One holds a mutex and sleeps, one waits for the
// mutex, one for a condition, one for a semaphore with a timeout; HANDS more wait for the condition. Virtual time jumps
// from 2 ms to 500 ms, and to 1 s. With `restless` the run is not repeatable: a thread sleeps for a time that depends
// on the id of the process.
#include <unistd.h>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <vector>
#include <waitpoint/fibers/sync/simulation.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

namespace threads = waitpoint::threads;
using namespace std::chrono_literals;

namespace {

struct Workshop {
  threads::mutex bench{"bench"};
  threads::mutex door{"door"};
  threads::condition_variable bell{"bell"};
  threads::counting_semaphore<8> springs{0, "springs"};
  bool rung = false;
  int clocks = 0;
  bool restless = false;
};

void make_clock(Workshop& workshop, int number) {
  const std::lock_guard lock(workshop.bench);
  threads::this_thread::sleep_for(workshop.restless ? std::chrono::nanoseconds(getpid()) : 1ms);
  workshop.clocks = number;
}

void wait_for_customer(Workshop& workshop) {
  std::unique_lock lock(workshop.door);
  workshop.bell.wait(lock, [&workshop] { return workshop.rung; });
}

void work(Workshop& workshop, int hands) {
  std::vector<threads::thread> all;
  all.emplace_back(threads::thread({.name = "master"}, [&] { make_clock(workshop, 1); }));
  all.emplace_back(threads::thread({.name = "journeyman"}, [&] { make_clock(workshop, 2); }));
  all.emplace_back(threads::thread({.name = "shop.keeper"}, [&] { wait_for_customer(workshop); }));
  all.emplace_back(threads::thread({.name = "apprentice"}, [&] {
    const bool came = workshop.springs.try_acquire_for(500ms);
    std::printf("springs: %s\n", came ? "yes" : "no");
    std::fflush(stdout);
  }));
  for (int hand = 0; hand < hands; ++hand)
    all.emplace_back(threads::thread({.name = "hand"}, [&] { wait_for_customer(workshop); }));
  threads::this_thread::sleep_for(1s);
  {
    const std::lock_guard lock(workshop.door);
    workshop.rung = true;
  }
  workshop.bell.notify_all();
  for (threads::thread& thread : all) thread.join();
  std::printf("clocks made: %d\n", workshop.clocks);
}

}  // namespace

int main(int argc, char** argv) {
  const int hands = argc > 1 ? std::atoi(argv[1]) : 0;
  Workshop workshop;
  workshop.restless = argc > 2;
  const waitpoint::Report report = waitpoint::simulate([&] { work(workshop, hands); });
  std::printf("%s, %llu events\n", to_string(report.digest).c_str(), static_cast<unsigned long long>(report.events));
  return report.passed ? 0 : 1;
}
