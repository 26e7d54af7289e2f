// SPDX-License-Identifier: BSD-3-Clause
// Each fiber has its own exceptions in flight and errno, wherever it is switched.
#include <gtest/gtest.h>

#include <cerrno>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

std::string current() {
  try {
    throw;
  } catch (const std::exception& e) {
    return e.what();
  }
}

TEST(Exceptions, ATaskThatWaitsInACatchBlockKeepsItsOwn) {
  in_every_order([] {
    std::vector<thread> threads;
    for (int t = 0; t < 6; ++t)
      threads.emplace_back([t] {
        for (int i = 0; i < 5; ++i) {
          const std::string mine = std::to_string(t) + " " + std::to_string(i);
          try {
            throw std::runtime_error(mine);
          } catch (const std::exception& e) {
            sleep_for((1 + (t + i) % 3) * 1ms);
            EXPECT_EQ(current(), mine);
            EXPECT_EQ(e.what(), mine);
            EXPECT_EQ(std::uncaught_exceptions(), 0);
            try {
              throw std::logic_error("inner " + mine);
            } catch (...) {
              this_thread::yield();
              EXPECT_EQ(current(), "inner " + mine);
            }
            EXPECT_EQ(current(), mine);
          }
          EXPECT_EQ(std::current_exception(), nullptr);
        }
      });
    for (thread& t : threads) t.join();
  });
}

TEST(Exceptions, ATaskThatWaitsInADestructorIsTheOnlyOneThatUnwinds) {
  struct Waits {
    ~Waits() {
      EXPECT_EQ(std::uncaught_exceptions(), 1);
      sleep_for(2ms);
      EXPECT_EQ(std::uncaught_exceptions(), 1);
    }
  };
  in_every_order([] {
    std::vector<thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([t] {
        sleep_for(t * 1ms);
        try {
          const Waits waits;
          throw std::runtime_error(std::to_string(t));
        } catch (const std::exception& e) {
          EXPECT_EQ(e.what(), std::to_string(t));
        }
      });
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(std::uncaught_exceptions(), 0);
      sleep_for(1ms);
    }
    for (thread& t : threads) t.join();
  });
}

TEST(Exceptions, ExceptionsOfTheCallingContextAreSeparate) {
  try {
    throw std::runtime_error("outside");
  } catch (const std::exception&) {
    in_order([] {
      EXPECT_EQ(std::current_exception(), nullptr);
      try {
        throw std::runtime_error("inside");
      } catch (const std::exception&) {
        sleep_for(1ms);
        EXPECT_EQ(current(), "inside");
      }
    });
    EXPECT_EQ(current(), "outside");
  }
}

TEST(Errno, EachTaskHasItsOwn) {
  errno = 77;
  in_every_order([] {
    EXPECT_EQ(errno, 0);
    std::vector<thread> threads;
    for (int t = 1; t <= 5; ++t)
      threads.emplace_back([t] {
        EXPECT_EQ(errno, 0);
        errno = t;
        for (int i = 0; i < 5; ++i) {
          sleep_for(1ms);
          EXPECT_EQ(errno, t);
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(errno, 0);
  });
  EXPECT_EQ(errno, 77);
  errno = 0;
}

}  // namespace
}  // namespace waitpoint
