// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/shared_mutex.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(SharedMutex, HasOneWriterOrManyReadersInEveryOrder) {
  in_every_order([] {
    shared_timed_mutex m;
    int writers = 0, readers = 0, most_readers = 0, total = 0;
    std::vector<thread> threads;
    for (int t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 12; ++i) {
          const bool has = t % 4 == 0   ? (m.lock(), true)
                           : t % 4 == 1 ? m.try_lock_for(i * 100us)
                           : t % 4 == 2 ? (m.lock_shared(), true)
                                        : m.try_lock_shared_for(i * 100us);
          if (!has) continue;
          ++total;
          ++(t % 4 < 2 ? writers : readers);
          most_readers = std::max(most_readers, readers);
          ASSERT_TRUE(writers == 0 || (writers == 1 && readers == 0));
          if ((i + t) % 2 == 0) sleep_for(100us);
          this_thread::yield();
          ASSERT_TRUE(writers == 0 || (writers == 1 && readers == 0));
          --(t % 4 < 2 ? writers : readers);
          t % 4 < 2 ? m.unlock() : m.unlock_shared();
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_GT(total, 48);
    EXPECT_GT(most_readers, 1);
  });
}

TEST(SharedMutex, TriesWithoutWaiting) {
  in_every_order([] {
    shared_mutex m;
    const auto others_get_it = [&] {
      std::string got;
      thread([&] {
        if (m.try_lock_shared()) {
          got += 'r';
          m.unlock_shared();
        }
        if (m.try_lock()) {
          got += 'w';
          m.unlock();
        }
      }).join();
      return got;
    };
    EXPECT_EQ(others_get_it(), "rw");
    {
      const std::shared_lock read(m);
      EXPECT_EQ(others_get_it(), "r");
    }
    {
      const std::unique_lock write(m);
      EXPECT_EQ(others_get_it(), "");
    }
    EXPECT_EQ(others_get_it(), "rw");
    EXPECT_EQ(now(), Time());
  });
}

// Tasks arrive at intervals of 1 ms and hold the lock for 10 ms: "task@time" in the order in which they get it.
std::string order_of(const std::string& tasks, const SimulationOptions& options = {}) {
  std::string order;
  const Report report = simulate(
      [&] {
        shared_mutex m;
        std::vector<thread> threads;
        for (std::size_t i = 0; i < tasks.size(); ++i)
          threads.emplace_back([&, i] {
            sleep_for(i * 1ms);
            const bool writes = tasks[i] == 'w';
            writes ? m.lock() : m.lock_shared();
            order += tasks[i] + std::to_string(i) + "@" + std::to_string(now().ns() / 1'000'000) + " ";
            sleep_for(10ms);
            writes ? m.unlock() : m.unlock_shared();
          });
        for (thread& t : threads) t.join();
      },
      options);
  EXPECT_TRUE(report.passed) << report;
  return order;
}

TEST(SharedMutex, ReadersAndWritersTakeTurnsInTheDefaultOrder) {
  EXPECT_EQ(order_of("rrr"), "r0@0 r1@1 r2@2 ");
  EXPECT_EQ(order_of("www"), "w0@0 w1@10 w2@20 ");
  // A reader does not overtake a waiting writer.
  EXPECT_EQ(order_of("rrwrr"), "r0@0 r1@1 w2@11 r3@21 r4@21 ");
  // After a writer all waiting readers enter together, then the next writer.
  EXPECT_EQ(order_of("wrwrw"), "w0@0 r1@10 r3@10 w2@20 w4@30 ");
  EXPECT_EQ(order_of("rwwr"), "r0@0 w1@10 r3@20 w2@30 ");
}

TEST(SharedMutex, SeededOrdersChooseTheNextHolder) {
  std::set<std::string> orders;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    std::string order = order_of("wrwrw", order_number(seed)), who;
    for (std::size_t i = 0; i < order.size(); i = order.find(' ', i) + 1) who += order.substr(i, 2);
    // The two readers enter together, in any order, before, between or after the writers.
    ASSERT_TRUE(who.find("r1r3") != std::string::npos || who.find("r3r1") != std::string::npos) << order;
    orders.insert(who);
  }
  EXPECT_EQ(orders.size(), 12u);  // orders of the pair of readers and two writers, times two
}

// Two generations of readers overlap without end; a lock that preferred readers would starve the writer.
TEST(SharedMutex, AStreamOfReadersDoesNotStarveAWriterNorTheOtherWayRound) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    const Report report = simulate(
        [&] {
          shared_mutex m;
          bool over = false;
          std::vector<thread> threads;
          for (int i = 0; i < 2; ++i)
            threads.emplace_back([&, i] {
              sleep_for(i * 1ms);
              while (!over) {
                const std::shared_lock read(m);
                sleep_for(2ms);
              }
            });
          sleep_for(10ms);
          m.lock();
          if (number == 0) {
            EXPECT_EQ(now(), at(11ms));  // at the first end of all readers
          }
          m.unlock();
          over = true;
          for (thread& t : threads) t.join();
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
  }
  in_order([] {
    shared_mutex m;
    bool over = false;
    std::vector<thread> threads;
    for (int i = 0; i < 3; ++i)
      threads.emplace_back([&] {
        while (!over) {
          const std::unique_lock write(m);
          sleep_for(2ms);
        }
      });
    sleep_for(11ms);
    m.lock_shared();
    EXPECT_EQ(now(), at(12ms));
    m.unlock_shared();
    over = true;
    for (thread& t : threads) t.join();
  });
}

TEST(SharedMutex, StateOfAnotherRunIsForgotten) {
  static shared_mutex left;
  for (int repeat = 0; repeat < 4; ++repeat) {
    {
      Simulation simulation;
      for (int i = 0; i < 3; ++i)
        simulation.spawn(simulation.environment(), {}, [=] {
          repeat % 2 == 0 ? left.lock() : left.lock_shared();
          sleep_for(1h);
        });
      EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::time_reached);
    }
    in_order([] {
      EXPECT_TRUE(left.try_lock());
      left.unlock();
      left.lock_shared();
      left.unlock_shared();
    });
  }
}

TEST(SharedMutexDeathTest, MisuseHasAName) {
  const char *tries = "a task tries to lock a shared mutex that it holds: shared mutex #1",
             *ends = "a thread ends while it holds a lock",
             *destroyed = "destroyed while it is held: shared mutex #1 \"short\", ";
  const char* not_writer = "a task unlocks a shared mutex that it does not hold as a writer: shared mutex #1";
  const char* not_reader = "a task unlocks a shared mutex that it does not hold as a reader: shared mutex #1";
  static shared_timed_mutex m("short");
  EXPECT_DEATH(simulate([] { m.unlock(); }), not_writer);
  EXPECT_DEATH(simulate([] { m.unlock_shared(); }), not_reader);
  EXPECT_DEATH(simulate([] { m.lock_shared(), m.unlock(); }), not_writer);
  EXPECT_DEATH(simulate([] { m.lock(), m.unlock_shared(); }), not_reader);
  EXPECT_DEATH(simulate([] {
                 m.lock_shared();
                 thread([] { m.unlock_shared(); }).join();
               }),
               "does not hold as a reader: shared mutex #[0-9]+ \"short\", shared by main of environment");
  EXPECT_DEATH(simulate([] { m.lock(), (void)m.try_lock(); }), tries);
  EXPECT_DEATH(simulate([] { m.lock(), (void)m.try_lock_shared(); }), tries);
  EXPECT_DEATH(simulate([] { m.lock_shared(), (void)m.try_lock_for(1ms); }), tries);
  EXPECT_DEATH(simulate([] { m.lock_shared(), (void)m.try_lock_shared_for(1ms); }), tries);
  EXPECT_DEATH(simulate([] { m.lock_shared(), m.lock_shared(); }), "a reader locks a shared mutex again");
  EXPECT_DEATH(simulate([] { m.lock(); }), ends);
  EXPECT_DEATH(simulate([] { m.lock_shared(); }), ends);
  EXPECT_DEATH(simulate([] { shared_mutex("short").lock(); }), destroyed);
  EXPECT_DEATH(simulate([] { shared_mutex("short").lock_shared(); }), destroyed);
}

}  // namespace
}  // namespace waitpoint
