// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/signals.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <string>
#include <vector>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/timer.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::handle_signal;
using this_thread::raise_signal;
using this_thread::sleep_for;

TEST(Signals, AreDeliveredAtTheNextWaitpointAndNotAmidstComputing) {
  in_every_order([] {
    std::string seen;
    thread other([&] {
      handle_signal(3, [&](int signal) { seen += "h" + std::to_string(signal) + "@" + std::to_string(now().ns()); });
      sleep_for(1us);
      compute(10us);
      seen += "c";
      mutex m;
      m.lock();
      seen += "l";
      m.unlock();
    });
    sleep_for(5us);
    EXPECT_EQ(send_signal(other, 3), signal_sent::pending);
    other.join();
    EXPECT_EQ(seen, "ch3@11000l");
  });
}

TEST(Signals, WaitUntilABlockingTaskContinues) {
  in_every_order([] {
    counting_semaphore<> units(0);
    std::vector<Time> handled;
    thread other([&] {
      handle_signal(1, [&](int) { handled.push_back(now()); });
      EXPECT_FALSE(units.try_acquire_for(5ms));  // the timeout is not shortened
      EXPECT_EQ(handled, std::vector{at(5ms)});
      units.acquire();
      EXPECT_EQ(handled, (std::vector{at(5ms), at(9ms)}));
    });
    sleep_for(2ms);
    send_signal(other, 1);
    sleep_for(5ms);
    send_signal(other, 1);
    sleep_for(2ms);
    units.release();
    other.join();
  });
}

TEST(Signals, PendingOnesCoalesceAndTheLeastNumberIsFirst) {
  in_every_order([] {
    std::string seen;
    thread other([&] {
      for (const int signal : {2, 7, 64}) handle_signal(signal, [&](int s) { seen += std::to_string(s) + " "; });
      sleep_for(10ms);
    });
    sleep_for(1ms);
    for (const int signal : {64, 7, 2, 7, 64, 7}) send_signal(other, signal);
    other.join();
    EXPECT_EQ(seen, "2 7 64 ");
  });
}

TEST(Signals, BlockedOnesStayPendingUntilTheyAreUnblocked) {
  in_every_order([] {
    int handled = 0;
    handle_signal(5, [&](int) { ++handled; });
    EXPECT_TRUE(this_thread::block_signals({5, 6}).empty());
    raise_signal(5);
    sleep_for(1ms);
    EXPECT_EQ(handled, 0);
    EXPECT_EQ(this_thread::pending_signals(), signal_set{5});
    EXPECT_EQ(this_thread::unblock_signals({6}), (signal_set{5, 6}));
    EXPECT_EQ(handled, 0);
    EXPECT_EQ(this_thread::blocked_signals(), signal_set{5});
    this_thread::unblock_signals(signal_set::all());
    EXPECT_EQ(handled, 1);
    EXPECT_TRUE(this_thread::pending_signals().empty());
  });
}

TEST(Signals, ASignalToOneselfIsHandledBeforeRaiseReturns) {
  in_every_order([] {
    int handled = 0;
    handle_signal(9, [&](int) { ++handled; });
    for (int i = 1; i <= 5; ++i) {
      raise_signal(9);
      EXPECT_EQ(handled, i);
    }
    EXPECT_EQ(send_signal(this_thread::get_id(), 9), signal_sent::pending);
    EXPECT_EQ(handled, 5);
    sleep_for(1us);
    EXPECT_EQ(handled, 6);
  });
}

TEST(Signals, AHandlerMayBlockAndItsOwnSignalWaitsMeanwhile) {
  in_every_order([] {
    std::string seen;
    counting_semaphore<> units(0);
    thread other([&] {
      handle_signal(1, [&](int) {
        seen += "(";
        units.acquire();
        seen += ")";
      });
      handle_signal(2, [&](int) { seen += "2"; });
      sleep_for(1ms);
      seen += "a";
      sleep_for(9ms);
      seen += "e";
    });
    sleep_for(2ms);
    send_signal(other, 1);
    sleep_for(9ms);  // it is in its handler now
    send_signal(other, 1);
    send_signal(other, 2);
    sleep_for(1ms);
    units.release();
    sleep_for(1ms);
    units.release();
    other.join();
    EXPECT_EQ(seen, "a(2)()e");
  });
}

TEST(Signals, ToAThreadThatEndedAreAnOutcome) {
  in_every_order([] {
    thread other([] { sleep_for(1ms); });
    const thread::id id = other.get_id();
    handle_robot_signal(4, [](int) {});
    EXPECT_EQ(send_signal(id, 4), signal_sent::pending);
    sleep_for(2ms);
    EXPECT_EQ(send_signal(other, 4), signal_sent::task_ended);
    EXPECT_EQ(send_signal(id, 4), signal_sent::task_ended);
    other.join();
  });
}

TEST(Signals, ARobotsHandlerServesItsTasksAndNoOthers) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    std::string seen;
    Simulation simulation(order_number(number));
    for (const char* name : {"dala", "rackham"})
      simulation.spawn(simulation.add_robot(name), {}, [&seen, name] {
        handle_robot_signal(1, [&seen, name](int) { seen += name[0]; });
        thread own([&] {
          handle_signal(1, [&](int) { seen += 'o'; });
          sleep_for(5ms);
        });
        thread other([] { sleep_for(6ms); });
        sleep_for(name[0] == 'd' ? 1ms : 2ms);
        send_signal(own, 1);
        send_signal(other, 1);
        own.join();
        other.join();
      });
    ASSERT_EQ(simulation.run_before(), RunEnd::ended);
    // Both robots' own handlers at 5 ms, then those of the robots.
    EXPECT_TRUE(seen == "oodr" || seen == "oord") << seen;
  }
}

TEST(Signals, ATimerSendsThem) {
  in_every_order([] {
    std::vector<Time> handled;
    thread other([&] {
      handle_signal(1, [&](int) { handled.push_back(now()); });
      for (int i = 0; i < 4; ++i) sleep_for(10ms);
    });
    timer beat([&] { send_signal(other, 1); });
    beat.start_every(Period::every(15ms));
    other.join();
    EXPECT_EQ(handled, (std::vector{at(20ms), at(30ms)}));
  });
}

TEST(Signals, ExceptionOfAHandlerEndsTheRun) {
  const Report report = simulate([] {
    mutex m;
    handle_signal(1, [](int) { throw std::runtime_error("from a handler"); });
    const std::lock_guard lock(m);
    raise_signal(1);
    ADD_FAILURE() << "not reached";
  });
  EXPECT_FALSE(report.passed);
  EXPECT_NE(report.text.find("from a handler"), std::string::npos) << report;
}

// The run ends while a handler waits, called from a function that must not throw.
TEST(Signals, AHandlerIsUnwoundWithItsTask) {
  Simulation simulation;
  bool left = false;
  simulation.spawn(simulation.environment(), {}, [&] {
    mutex m;
    handle_signal(1, [&](int) {
      struct Guard {
        bool& left;
        ~Guard() { left = true; }
      } guard{left};
      sleep_for(1h);
    });
    const thread::id self = this_thread::get_id();
    {
      const std::lock_guard lock(m);
      send_signal(self, 1);
    }  // the waitpoint of unlock
    sleep_for(1h);
  });
  EXPECT_EQ(simulation.run_before(at(1s)), RunEnd::time_reached);
  EXPECT_FALSE(left);
  simulation.unwind();
  EXPECT_TRUE(left);
  EXPECT_TRUE(simulation.abandoned().empty());
}

TEST(Signals, DigestsRepeatAndTellWhatWasDelivered) {
  const auto run = [](std::uint64_t number, int signal) {
    return simulate(
               [&] {
                 handle_robot_signal(1, [](int) {});
                 handle_robot_signal(2, [](int) {});
                 thread other([] { sleep_for(2ms); });
                 send_signal(other, signal);
                 other.join();
               },
               order_number(number))
        .digest.value();
  };
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    EXPECT_EQ(run(number, 1), run(number, 1));
    EXPECT_NE(run(number, 1), run(number, 2));
  }
}

TEST(SignalsDeathTest, Misuse) {
  EXPECT_DEATH(simulate([] { raise_signal(1); }), "has no handler for it");
  EXPECT_DEATH(simulate([] { raise_signal(0); }), "no signal has this number");
  EXPECT_DEATH(simulate([] { handle_signal(65, [](int) {}); }), "no signal has this number");
  EXPECT_DEATH(simulate([] { send_signal(thread(), 1); }), "a signal is sent through an empty thread handle");
  EXPECT_DEATH(raise_signal(1), "outside a simulated task");
}

}  // namespace
}  // namespace waitpoint
