// SPDX-License-Identifier: BSD-3-Clause
// A test of a user's own threads, with a bug that few schedules show: a notification before the wait is lost.
#include <gtest/gtest.h>

#include <mutex>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

namespace {

namespace threads = waitpoint::threads;  // the code under test uses this name instead of std

void lose_a_letter() {
  threads::mutex door("door");
  threads::condition_variable bell("bell");
  threads::thread reader({.name = "reader"}, [&] {
    std::unique_lock lock(door);
    bell.wait(lock);  // without a predicate: an earlier notification is lost
  });
  threads::thread postman({.name = "postman"}, [&] { bell.notify_one(); });
  postman.join();
  reader.join();
}

void deliver_a_letter() {
  threads::mutex door("door");
  threads::condition_variable bell("bell");
  bool delivered = false;
  threads::thread reader({.name = "reader"}, [&] {
    std::unique_lock lock(door);
    bell.wait(lock, [&] { return delivered; });
  });
  threads::thread postman({.name = "postman"}, [&] {
    const std::lock_guard lock(door);
    delivered = true;
    bell.notify_one();
  });
  postman.join();
  reader.join();
}

TEST(Letter, ArrivesInTheDefaultOrder) {
  const waitpoint::Report report = waitpoint::simulate(lose_a_letter);
  EXPECT_TRUE(report.passed) << report;
}

TEST(Letter, ArrivesInEverySchedule) {
  const auto report = waitpoint::explore(lose_a_letter);
  EXPECT_TRUE(report.passed) << report;
}

TEST(MendedLetter, ArrivesInEverySchedule) {
  const auto report = waitpoint::explore(deliver_a_letter, {.strategy = "dpor"});
  EXPECT_TRUE(report.passed) << report;
  EXPECT_TRUE(report.complete);  // all schedules were tried
}

}  // namespace
