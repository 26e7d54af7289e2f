// SPDX-License-Identifier: BSD-3-Clause
// Bugs of time: they need computations that take less or more than usual, and events that coincide. In the default
// order each computation takes its maximum.
#include <array>
#include <deque>
#include <mutex>
#include <type_traits>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/priority_mutex.hpp"
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {
namespace {

using namespace std::chrono_literals;

// The loop takes one command each period. A planner that is faster for a while fills the queue, and the last command is
// dropped. Mended, the loop takes all commands.
template <bool mended>
void missed_period() {
  constexpr std::size_t room = 4;
  constexpr int commands = 6;
  mutex lock;
  std::deque<int> queue;
  int taken = 0, dropped = 0;
  Crew crew;
  crew.add("planner", [&] {
    for (int i = 0; i < commands; ++i) {
      compute(3ms, 10ms);
      const std::lock_guard guard(lock);
      queue.size() < room ? queue.push_back(i) : void(++dropped);
    }
  });
  crew.add("control", [&] {
    for (int period = 1; taken + dropped < commands; ++period) {
      this_thread::sleep_until(Time() + Duration(10ms) * period);
      const std::lock_guard guard(lock);
      do {
        if (queue.empty()) break;
        queue.pop_front();
        ++taken;
      } while (mended);
    }
  });
  crew.join();
  check(dropped == 0, "a command is dropped");
}

// A request that timed out is repeated, and the answer to the first is taken for that to the second. Mended, answers
// have the number of their request.
template <bool mended>
void timeout_race() {
  mutex lock;
  condition_variable changed;
  int asked = 0, answered = 0, answer = 0;
  Crew crew;
  crew.add("server", [&] {
    for (int request = 1; request <= 2; ++request) {
      std::unique_lock guard(lock);
      changed.wait(guard, [&] { return asked >= request; });
      guard.unlock();
      compute(3ms, 8ms);
      guard.lock();
      answered = request;
      answer = 10 * request;
      changed.notify_all();
    }
  });
  crew.add("client", [&] {
    std::unique_lock guard(lock);
    asked = 1;
    changed.notify_all();
    if (changed.wait_for(guard, 5ms, [&] { return answered == 1; })) {
      asked = 2;  // tells the server to end
      changed.notify_all();
      return;
    }
    guard.unlock();
    compute(1ms, 6ms);  // its work before the repetition
    guard.lock();
    answer = 0;
    asked = 2;
    changed.notify_all();
    changed.wait(guard, [&] { return mended ? answered == 2 : answer != 0; });
    check(answer == 20, "the answer to another question");
  });
  crew.join();
}

// The wait ends at its deadline, and at that instant the letter arrives: the reader leaves without it.
template <bool mended>
void deadline_tie() {
  mutex lock;
  condition_variable arrived;
  bool letter = false;
  Crew crew;
  crew.add("reader", [&] {
    std::unique_lock guard(lock);
    bool timed_out = false;
    while (!letter && !timed_out) timed_out = arrived.wait_for(guard, 5ms) == cv_status::timeout;
    if (mended && letter) timed_out = false;
    check(!timed_out || !letter, "a letter is left behind");
  });
  crew.add("writer", [&] {
    compute(4ms, 5ms);
    const std::lock_guard guard(lock);
    letter = true;
    arrived.notify_one();
  });
  crew.join();
}

// As on Mars: an urgent task waits for the bus, held by a thread that does not get the processor.
template <bool mended>
void priority_inversion() {
  processor board;
  std::conditional_t<mended, priority_mutex, mutex> bus("bus");
  thread low({.name = "weather", .on = &board, .priority = 1}, [&] {
    compute(1ms, 4ms);
    const std::lock_guard guard(bus);
    compute(2ms);
  });
  thread middle({.name = "radio", .on = &board, .priority = 2}, [&] {
    this_thread::sleep_until(Time() + 2ms);
    compute(20ms);
  });
  thread high({.name = "bus", .on = &board, .priority = 3}, [&] {
    this_thread::sleep_until(Time() + 2ms);
    const std::lock_guard guard(bus);
    compute(500us);
    check(now() < Time() + 10ms, "the deadline is missed");
  });
  for (thread* each : {&low, &middle, &high}) each->join();
}

// The watchdog reads the kick, writes its log and then clears it: kicks in between are lost. Three in a row stop the
// robot. Mended, it clears what it has read.
template <bool mended>
void watchdog_against_kick() {
  constexpr int rounds = 5, tolerated = 2;
  atomic<bool> kicked(false);
  Crew crew;
  crew.add("driver", [&] {
    for (int round = 0; round <= rounds; ++round) {
      this_thread::sleep_until(Time() + Duration(10ms) * round);
      compute(0ms, 4ms);
      kicked.store(true);
    }
  });
  crew.add("watchdog", [&] {
    for (int round = 0, missed = 0; round <= rounds; ++round) {
      this_thread::sleep_until(Time() + 5ms + Duration(10ms) * round);
      const bool seen = mended ? kicked.exchange(false) : kicked.load();
      compute(0ms, 6ms);
      if (!mended) kicked.store(false);
      missed = seen ? 0 : missed + 1;
      check(missed <= tolerated, "the watchdog bites although it was kicked");
    }
  });
  crew.join();
}

// Measurements are applied in order of arrival: one with a long delay arrives after another that was taken three later.
// Three such jumps, and the robot is lost. Mended, measurements older than the estimate are left out.
template <bool mended>
void late_measurement() {
  constexpr int measurements = 6, tolerated = 2;
  mutex lock;
  int estimate = 0, jumps = 0;
  Crew crew;
  for (int i = 1; i <= measurements; ++i)
    crew.add("camera", [&, i] {
      this_thread::sleep_until(Time() + Duration(5ms) * i);
      compute(1ms, 20ms);  // recognition in the image
      const std::lock_guard guard(lock);
      if (mended && i < estimate) return;
      jumps += estimate - i > tolerated;
      estimate = i;
      check(jumps < 3, "the robot jumps to where it was, again and again");
    });
  crew.join();
}

}  // namespace

Specimens timings() {
  return {{"missed period", missed_period<false>, missed_period<true>, 4, "timing"},
          {"timeout race", timeout_race<false>, timeout_race<true>, 1, "timing"},
          {"deadline tie", deadline_tie<false>, deadline_tie<true>, 1, "timing"},
          {"priority inversion", priority_inversion<false>, priority_inversion<true>, 1, "timing"},
          {"watchdog against kick", watchdog_against_kick<false>, watchdog_against_kick<true>, 3, "timing"},
          {"late measurement", late_measurement<false>, late_measurement<true>, 3, "timing"}};
}

}  // namespace waitpoint::zoo
