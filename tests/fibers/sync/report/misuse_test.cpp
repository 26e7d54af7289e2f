// SPDX-License-Identifier: BSD-3-Clause
// Each misuse of a primitive ends the process with a report, and is not undefined behaviour.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/kernel/call_stack.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/periodic_timer.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// The line of a misuse, in the innermost frame of this file. "" where frames have no lines.
std::string at_line(int line) {
  std::vector<sync::ReturnAddresses> stacks(1, sync::ReturnAddresses(4));
  stacks[0].resize(kernel::capture_call_stack(stacks[0].data(), stacks[0].size()));
  const auto lines = sync::user_source_lines(stacks, 1);
  const bool has_lines = !lines[0].empty() && lines[0][0].find("misuse_test.cpp:") != std::string::npos;
  return has_lines ? ".*misuse_test.cpp:" + std::to_string(line) + "\n" : "";
}

// The lock is not held in line_of_unlock; the thread is joinable in the last line of destroy_joinable().
constexpr int line_of_unlock = __LINE__ + 1;
void unlock(mutex& m) { m.unlock(); }
void destroy_joinable() {
  const thread worker({.name = "worker"}, [] { this_thread::sleep_for(1h); });
  this_thread::sleep_for(3ms);
}
constexpr int line_of_destruction = __LINE__ - 1;

TEST(MisuseDeathTest, IsReportedAtTheCallersLine) {
  EXPECT_DEATH(
      simulate([] {
        mutex m("left");
        unlock(m);
      }),
      "^waitpoint: misuse: a task unlocks a mutex that it does not hold: mutex #1 \"left\"\n"
      "  at virtual time 0.000000000 s, in task main of environment, at its event [^\n]*\n(  replay[^\n]*\n)?" +
          at_line(line_of_unlock));
  EXPECT_DEATH(
      simulate(destroy_joinable),
      "^waitpoint: misuse: a thread that is joinable is destroyed\n"
      "  at virtual time 0.003000000 s, in task main of environment, at its event [^\n]*\n(  replay[^\n]*\n)?" +
          at_line(line_of_destruction));
}

TEST(MisuseDeathTest, OutsideOfTasksIsReportedAtTheCallersLine) {
  mutex m;
  EXPECT_DEATH(unlock(m), "^waitpoint: misuse: a simulated primitive is used outside a simulated task\n" +
                              at_line(line_of_unlock));
}

TEST(MisuseDeathTest, UnlockingWhatOneDoesNotHold) {
  const char* message = "a task unlocks a mutex that it does not hold";
  EXPECT_DEATH(simulate([] { mutex().unlock(); }), message);
  EXPECT_DEATH(simulate([] {
                 mutex m;
                 m.lock();
                 thread([&] { m.unlock(); }).join();
               }),
               message);
  EXPECT_DEATH(simulate([] {
                 mutex m;
                 m.lock();
                 m.unlock();
                 m.unlock();
               }),
               message);
}

TEST(MisuseDeathTest, WaitingOnAConditionWithoutTheLock) {
  const char* message = "waits on a condition variable without holding the lock";
  EXPECT_DEATH(simulate([] {
                 mutex m;
                 std::unique_lock lock(m, std::defer_lock);
                 condition_variable().wait(lock);
               }),
               message);
}

TEST(MisuseDeathTest, UseOutsideAnyTask) {
  const char* message = "a simulated primitive is used outside a simulated task";
  EXPECT_DEATH(mutex().lock(), message);
  EXPECT_DEATH(mutex().try_lock(), message);
  EXPECT_DEATH(timed_mutex().try_lock_for(1ms), message);
  EXPECT_DEATH(condition_variable().notify_one(), message);
  EXPECT_DEATH(counting_semaphore<>(1).acquire(), message);
  EXPECT_DEATH(counting_semaphore<>(1).release(), message);
  EXPECT_DEATH(periodic_timer(Period::hertz(1)).wait(), message);
  EXPECT_DEATH(thread([] {}), message);
  EXPECT_DEATH(this_thread::sleep_for(1ms), message);
  EXPECT_DEATH(this_thread::yield(), message);
  EXPECT_DEATH(now(), message);
  EXPECT_DEATH(compute(1ms), message);
}

TEST(MisuseDeathTest, ReleasingASemaphoreBeyondItsGreatestCount) {
  const char* message = "released beyond its greatest count";
  EXPECT_DEATH(simulate([] { binary_semaphore(1).release(); }), message);
  EXPECT_DEATH(simulate([] { counting_semaphore<3>(1).release(3); }), message);
  EXPECT_DEATH(simulate([] { counting_semaphore<>(0).release(-1); }), "released by a negative number");
}

TEST(MisuseDeathTest, ThreadsThatAreNotJoinable) {
  EXPECT_DEATH(simulate([] { thread().join(); }), "not joinable is joined");
  EXPECT_DEATH(simulate([] { thread().detach(); }), "not joinable is detached");
  EXPECT_DEATH(simulate([] {
                 thread t([] {});
                 t.join();
                 t.join();
               }),
               "not joinable is joined");
  EXPECT_DEATH(simulate([] { thread t([] { this_thread::sleep_for(1ms); }); }),
               "a thread that is joinable is destroyed.*task main of environment");
  EXPECT_EXIT(simulate([] {
                thread t([] { this_thread::sleep_for(1ms); });
                t = thread();
              }),
              testing::KilledBySignal(SIGABRT), "");
}

TEST(MisuseDeathTest, ComputingForANegativeTime) {
  EXPECT_DEATH(simulate([] { compute(-1ns); }), "a computing time is negative");
}

TEST(MisuseDeathTest, ComputingBeyondTheEndOfTime) {
  EXPECT_DEATH(simulate([] {
                 compute(Duration::max());
                 compute(1ns);
               }),
               "virtual time overflows");
  EXPECT_DEATH(simulate([] { access_hardware(-1ns); }), "an access to hardware has a negative latency");
}

TEST(MisuseDeathTest, AnIntervalWhoseEndsAreSwapped) {
  const char* message = "the ends of an interval of computing times are swapped";
  EXPECT_DEATH(simulate([] { compute(2ms, 1ms); }), message);
  EXPECT_DEATH(simulate([] {
                 const kernel::ClockOptions swapped{
                     .kind = kernel::ClockKind::interval, .least = Duration(2ms), .greatest = Duration(1ms)};
                 thread({.clock = swapped}, [] {}).join();
               }),
               message);
}

TEST(MisuseDeathTest, TwoRobotsOfOneName) {
  EXPECT_DEATH(
      {
        Simulation simulation;
        simulation.add_robot("r");
        simulation.add_robot("r");
      },
      "two robots of one name");
  EXPECT_DEATH(Simulation().add_robot(std::string(48, 'r')), "a robot's name is too long");
}

// Each level uses a kilobyte; the compiler must neither turn it into a loop nor use less.
int deep(int levels) {
  int (*volatile next)(int) = deep;
  char room[1024];
  room[0] = static_cast<char>(levels);
  asm volatile("" : : "r"(room) : "memory");
  return levels == 0 ? 0 : next(levels - 1) + room[0];
}

TEST(MisuseDeathTest, AStackThatOverflowsCrashesInsteadOfCorrupting) {
  for (const auto size : {kernel::StackSize::small, kernel::StackSize::medium, kernel::StackSize::large}) {
    kernel::sanitizer::look();  // with a sanitizer all stacks are large
    const kernel::StackSize real = kernel::sanitizer::present ? kernel::StackSize::large : size;
    const int room_kb = static_cast<int>(kernel::bytes(real) / 1024);
    EXPECT_DEATH(simulate([&] { thread({.stack = size}, [&] { deep(room_kb + 8); }).join(); }), "");
    EXPECT_TRUE(simulate([&] { thread({.stack = size}, [&] { deep(room_kb / 3); }).join(); }).passed);
  }
}

}  // namespace
}  // namespace waitpoint
