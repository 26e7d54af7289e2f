// SPDX-License-Identifier: BSD-3-Clause
// Primitives that act on more than their own object: dpor finds every result.
#include <gtest/gtest.h>

#include <set>

#include "fibers/explore/body.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/io/datagram_socket.hpp"
#include "fibers/io/pipe.hpp"
#include "fibers/io/poll.hpp"
#include "fibers/laas/taskLib.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/processor.hpp"
#include "fibers/sync/signals.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using std::chrono::seconds;

// The results that `body` writes under all schedules; those that dfs finds among its first ten thousand belong to them.
std::set<std::string> results(const std::function<void(std::string& result)>& body) {
  std::string result;
  exploration::Body runs([&] { body(result); }, nullptr, Time() + std::chrono::hours(1), 100'000);
  const auto found_by = [&](const char* name, std::uint64_t schedules_max) {
    std::set<std::string> found;
    const auto strategy = exploration::make_strategy(name);
    const exploration::Profile profile;
    for (std::uint64_t number = 0; number < schedules_max; ++number) {
      result.clear();
      strategy->begin(number, {}, profile);
      if (!runs.run(*strategy).was_cut) found.insert(result);
      if (!strategy->end()) return found;
    }
    return found;
  };
  std::set<std::string> by_dpor = found_by("dpor", 100'000);
  for (const std::string& by_dfs : found_by("dfs", 10'000)) EXPECT_TRUE(by_dpor.contains(by_dfs)) << by_dfs;
  return by_dpor;
}

using Results = std::set<std::string>;

TEST(Dependence, ASignalActsAtAnyEventOfItsThread) {
  EXPECT_EQ(results([](std::string& result) {
              int handled = 0;
              atomic<int> other{0};
              handle_robot_signal(1, [&](int) { handled = 1; });
              thread receiver([&] {
                other.load();
                result = handled != 0 ? "before" : "after";
                other.load();
              });
              send_signal(receiver.get_id(), 1);
              receiver.join();
            }),
            Results({"before", "after"}));
}

TEST(Dependence, APollLooksAtEveryChannel) {
  EXPECT_EQ(results([](std::string& result) {
              auto first = io::make_pipe(), second = io::make_pipe();
              const std::byte letter{1};
              thread a([&] { (void)first.writer.write({&letter, 1}); });
              thread b([&] { (void)second.writer.write({&letter, 1}); });
              io::PollEntry entries[] = {{first.reader, io::Events::readable}, {second.reader, io::Events::readable}};
              (void)io::poll(entries, {});
              for (const io::PollEntry& entry : entries) result += any(entry.ready) ? "x" : "-";
              a.join();
              b.join();
            }),
            Results({"x-", "-x", "xx"}));
}

TEST(Dependence, AChannelHasTwoSides) {
  EXPECT_EQ(results([](std::string& result) {
              auto pipe = io::make_pipe();
              std::byte letter{1};
              thread writer([&] { (void)pipe.writer.write({&letter, 1}); });
              result = pipe.reader.read({&letter, 1}, io::no_wait) ? "read" : "empty";
              writer.join();
            }),
            Results({"read", "empty"}));
}

TEST(Dependence, ANameIsBoundOnce) {
  EXPECT_EQ(results([](std::string& result) {
              io::Network network;
              io::datagram_socket first(network), second(network);
              const auto bind = [&](io::datagram_socket& socket, const char* name) {
                if (socket.bind("port") == io::Status::ok) result += name;
              };
              thread other([&] { bind(first, "first"); });
              bind(second, "second");
              other.join();
            }),
            Results({"first", "second"}));
}

TEST(Dependence, AResumptionActsOnASuspendedTask) {
  EXPECT_EQ(results([](std::string& result) {
              const long task = laas::taskSpawn("suspended", 100, 0, 20'000, [&] {
                laas::taskSuspend(0);
                result = "resumed";
              });
              laas::taskResume(task);
            }),
            Results({"resumed", ""}));
}

TEST(Dependence, ThreadsOnOneProcessorDelayEachOther) {
  EXPECT_EQ(results([](std::string& result) {
              processor shared;
              atomic<int> of_a{0}, of_b{0};
              const auto work = [&](const char* name, const atomic<int>& own) {
                own.load();
                compute(seconds(1));
                result += name;
              };
              thread a({.on = &shared}, [&] { work("a", of_a); });
              thread b({.on = &shared}, [&] { work("b", of_b); });
              a.join();
              b.join();
            }),
            Results({"ab", "ba"}));
}

TEST(Dependence, AStopRequestTakesAWaiterFromNotifications) {
  EXPECT_EQ(results([](std::string& result) {
              mutex lock;
              condition_variable_any condition;
              stop_source stop;
              thread stoppable([&] {
                std::unique_lock<mutex> held(lock);
                condition.wait(held, stop.get_token(), [] { return false; });
              });
              thread waiter([&] {
                this_thread::sleep_for(seconds(1));
                std::unique_lock<mutex> held(lock);
                condition.wait(held);
                result += "woken";
              });
              thread notifier([&] {
                this_thread::sleep_for(seconds(2));
                condition.notify_one();
              });
              this_thread::sleep_for(seconds(2));
              stop.request_stop();
              this_thread::sleep_for(seconds(1));
              result += "|";
              condition.notify_all();
              stoppable.join();
              waiter.join();
              notifier.join();
            }),
            Results({"woken|", "|woken"}));
}

TEST(Dependence, AServiceMayFailBeforeTheRunEnds) {
  atomic<int> steps{0};  // outlives the body
  const ExploreReport report = explore(
      [&] {
        thread({.service = true}, [&] {
          for (int i = 0; i < 4; ++i) steps.store(i);
          check(false, "the service fails");
        }).detach();
      },
      {.strategy = "dpor"});
  EXPECT_FALSE(report.passed) << report.scope;
}

}  // namespace
}  // namespace waitpoint
