// SPDX-License-Identifier: BSD-3-Clause
// A run that ends before its tasks do unwinds their stacks: every destructor runs, nothing hangs or leaks.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/periodic_timer.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/leaks.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Names = std::vector<std::string>;

int alive = 0;

struct Counted {
  Counted() { ++alive; }
  Counted(const Counted&) { ++alive; }
  ~Counted() { --alive; }
};

// Runs `body` as a task until 10 ms and ends the run there; returns the tasks that could not be unwound.
Names break_off(const std::function<void()>& body, const SimulationOptions& options = {}) {
  Simulation simulation(options);
  simulation.spawn(simulation.environment(), {.name = "main"}, body);
  EXPECT_EQ(simulation.run_before(Time() + Duration(10ms)), RunEnd::time_reached) << simulation.trouble();
  const Time reached = simulation.global_time();
  simulation.unwind();
  EXPECT_EQ(simulation.global_time(), reached);
  return simulation.abandoned();
}

TEST(Unwinding, RunsTheDestructorsWhereverATaskWaits) {
  const std::function<void()> waits[] = {
      [] { sleep_for(1h); },
      [] {
        for (;;) sleep_for(3ms);
      },
      [] {
        for (;;) {
          compute(1ms);
          this_thread::yield();
        }
      },
      [] {
        mutex m;
        m.lock();
        thread other([&] { const std::lock_guard guard(m); });
        sleep_for(1h);
      },
      [] {
        timed_mutex m;
        m.lock();
        thread other([&] { (void)m.try_lock_for(1h); });
        other.join();
      },
      [] {
        mutex m;
        condition_variable c;
        std::unique_lock lock(m);
        c.wait_for(lock, 1h, [] { return false; });
      },
      [] { (void)binary_semaphore(0).try_acquire_for(1h); },
      [] {
        for (periodic_timer timer(Period::hertz(75));;) timer.wait();
      },
      [] {
        thread keeps_going([] { sleep_for(1h); });
        counting_semaphore<>(0).acquire();
      },
  };
  for (const auto& wait : waits)
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const SimulationOptions options{seed == 0 ? kernel::Order::fifo : kernel::Order::seeded, seed, ""};
      EXPECT_EQ(break_off(
                    [&] {
                      const Counted local;
                      const auto owned = std::make_unique<Counted>();
                      std::vector<thread> others;
                      for (int i = 0; i < 3; ++i) others.emplace_back([&wait, captured = Counted()] { wait(); });
                      const Counted later;
                      wait();
                    },
                    options),
                Names());
      EXPECT_EQ(alive, 0);
    }
}

TEST(Unwinding, LetsGoOfWhatTasksOwnThatNeverBegan) {
  {
    Simulation simulation;
    for (int i = 0; i < 3; ++i)
      simulation.spawn(simulation.environment(), {}, [captured = Counted()] { ADD_FAILURE(); });
    EXPECT_EQ(alive, 3);
    EXPECT_EQ(simulation.run_before(Time()), RunEnd::time_reached);
  }
  EXPECT_EQ(alive, 0);
}

TEST(Unwinding, FollowsADeadlockAnExceptionAndTheEndOfARun) {
  const std::function<void()> ends[] = {
      [] {
        mutex m;
        m.lock();
        m.lock();
      },
      [] { throw std::runtime_error("over"); },
      [] {
        for (;;) this_thread::yield();
      },
      [] {},
  };
  for (const auto& end : ends) {
    simulate([&] {
      const Counted local;
      thread({.service = true}, [captured = Counted()] { sleep_for(1h); }).detach();
      sleep_for(1ms);
      end();
    });
    EXPECT_EQ(alive, 0);
  }
}

// Objects that a task borrows from the frames of its parent still exist when the task's own destructors run.
TEST(Unwinding, ChildrenLeaveBeforeTheirParents) {
  std::string order;
  struct Note {
    ~Note() { to += text; }
    std::string& to;
    const char* text;
  };
  EXPECT_EQ(break_off([&] {
              std::vector<int> borrowed(3, 7);
              struct Borrower {
                ~Borrower() { sum = of[0] + of[1] + of[2], of.assign(100, 1); }
                std::vector<int>& of;
                int& sum;
              };
              int sum = 0;
              struct Check {
                ~Check() { EXPECT_EQ(sum, 21); }
                int& sum;
              } check{sum};
              const Note note{order, "parent "};
              thread child([&] {
                const Note inner{order, "child "};
                const Borrower borrower{borrowed, sum};
                sleep_for(1h);
              });
              child.join();
            }),
            Names());
  EXPECT_EQ(order, "child parent ");
}

// Objects are destroyed with their owner's frame or heap block while other tasks still wait for them.
TEST(Unwinding, TouchesNoObjectThatIsGone) {
  struct Shared {
    mutex m;
    counting_semaphore<> s{0};
    condition_variable c;
    periodic_timer timer{Period::every(1s)};
  };
  std::vector<std::unique_ptr<Shared>> owners;
  EXPECT_EQ(break_off([&] {
              Shared* shared = owners.emplace_back(std::make_unique<Shared>()).get();
              shared->m.lock();
              for (int i = 0; i < 3; ++i) {
                thread([=] { shared->m.lock(); }).detach();
                thread([=] { shared->s.acquire(); }).detach();
                thread([=] { shared->timer.wait(); }).detach();
              }
              // The youngest task is unwound first, and destroys the objects that the others wait for.
              thread([&] {
                struct Breaker {
                  ~Breaker() {
                    auto& memory = *owners.back();
                    memory.~Shared();
                    std::memset(static_cast<void*>(&memory), 0xAB, sizeof memory);
                  }
                  std::vector<std::unique_ptr<Shared>>& owners;
                } breaker{owners};
                sleep_for(1h);
              }).detach();
              sleep_for(1h);
            }),
            Names());
  const auto* bytes = reinterpret_cast<const unsigned char*>(owners.back().get());
  for (std::size_t i = 0; i < sizeof(Shared); ++i) ASSERT_EQ(bytes[i], 0xAB) << i;
  operator delete(owners.back().release());
}

TEST(Unwinding, DestructorsMayReleaseAndMayCallWhatBlocks) {
  mutex m;
  condition_variable c;
  counting_semaphore<> s(0);
  periodic_timer timer(Period::every(1ms));
  struct Cleanup {
    ~Cleanup() {
      m.lock();
      (void)m.try_lock();
      m.unlock();
      c.notify_one();
      c.notify_all();
      s.acquire();
      s.release();
      timer.wait();
      sleep_for(1h);
      this_thread::yield();
      thread other([] {});
      if (other.joinable()) other.join();
      std::unique_lock lock(m);
      c.wait(lock);
      ++done;
    }
    mutex& m;
    condition_variable& c;
    counting_semaphore<>& s;
    periodic_timer& timer;
    int& done;
  };
  int done = 0;
  EXPECT_EQ(break_off([&] {
              const Cleanup cleanup{m, c, s, timer, done};
              std::unique_lock lock(m);
              c.wait_for(lock, 1h);
            }),
            Names());
  EXPECT_EQ(done, 1);
}

TEST(Unwinding, IsRethrownThroughCatchAll) {
  int caught = 0;
  EXPECT_EQ(break_off([&] {
              const Counted local;
              for (int i = 0; i < 3; ++i) {
                try {
                  sleep_for(1h);
                } catch (...) {
                  ++caught;
                }
              }
            }),
            Names());
  EXPECT_EQ(caught, 3);
  EXPECT_EQ(alive, 0);
}

TEST(Unwinding, IsNoFailureWhenATaskMakesAnotherExceptionOfIt) {
  EXPECT_EQ(break_off([] {
              const Counted local;
              try {
                sleep_for(1h);
              } catch (...) {
                throw std::runtime_error("wrapped");
              }
            }),
            Names());
  EXPECT_EQ(alive, 0);
}

TEST(Unwinding, NamesTheTasksThatNeverLeave) {
  const LeaksOnPurpose leaks;
  EXPECT_EQ(break_off([] {
              thread({.name = "swallows"}, [] {
                for (;;) try {
                    sleep_for(1h);
                  } catch (...) {
                  }
              }).detach();
              thread({.name = "only releases"}, [] {
                for (counting_semaphore<> s(0);; s.release()) compute(1ms);
              }).detach();
              thread({.name = "leaves"}, [] { sleep_for(1h); }).detach();
            }),
            (Names{"swallows of environment", "only releases of environment"}));
}

// A destructor lets no exception through: a task that waits in one when the run ends cannot be unwound.
TEST(Unwinding, NamesTheTasksThatWaitInADestructor) {
  const LeaksOnPurpose leaks;
  struct Pool {
    ~Pool() { worker.join(); }
    thread worker{{.name = "worker"}, [] {
                    const Counted local;
                    sleep_for(1h);
                  }};
  };
  const std::terminate_handler before = std::get_terminate();
  EXPECT_EQ(break_off([] {
              const Counted outer;
              { const Pool pool; }
            }),
            Names{"main of environment"});
  EXPECT_EQ(alive, 1);  // leaked
  alive = 0;
  EXPECT_EQ(std::get_terminate(), before);
  const Report report = simulate([] {
    thread({.name = "keeper", .service = true}, [] { const Pool pool; }).detach();
    sleep_for(1ms);
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.abandoned, Names{"keeper of environment"});
  alive = 0;
}

TEST(UnwindingDeathTest, AnotherTerminationWhileUnwindingIsOne) {
  EXPECT_DEATH(break_off([] {
                 struct Fails {
                   ~Fails() { std::terminate(); }
                 } fails;
                 sleep_for(1h);
               }),
               "");
}

TEST(Unwinding, StartsNoThreads) {
  bool ran = false;
  struct Starter {
    ~Starter() {
      thread([this] { ran = true; }).detach();
    }
    bool& ran;
  };
  EXPECT_EQ(break_off([&] {
              const Starter starter{ran};
              sleep_for(1h);
            }),
            Names());
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace waitpoint
