// SPDX-License-Identifier: BSD-3-Clause
// Messages between robots arrive in an order of their own: by time, sender, and the sender's count of messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "fibers/kernel/messages.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

struct ArrivedMessage : EventNode {
  std::vector<std::string>* log = nullptr;
  std::string text;
};

void note(EventNode& node) {
  auto& arrival = static_cast<ArrivedMessage&>(node);
  arrival.log->push_back(arrival.text);
}

// Two senders of two messages each, all due at 50 ns, put into the event list in the order of `who`.
std::vector<std::string> arrivals(const std::vector<int>& who, Order order) {
  std::vector<std::string> log;
  std::vector<ArrivedMessage> messages(who.size());
  std::array<Robot, 2> senders;
  TaskRun run(order, 7);
  kernel::add_robot(run.scheduler, senders[0], "ada");
  kernel::add_robot(run.scheduler, senders[1], "bob");
  run.spawn([&] {
    for (std::size_t i = 0; i < who.size(); ++i) {
      Robot& sender = senders[static_cast<std::size_t>(who[i])];
      messages[i].fire = note;
      messages[i].log = &log;
      messages[i].text = sender.name + std::to_string(sender.messages);
      kernel::deliver(run.scheduler, messages[i], Time::from_ns(50), sender);
    }
    run.sleep(50);
    log.push_back("task");
  });
  kernel::run_before(run.scheduler, Time::max());
  return log;
}

TEST(Deliveries, AreOrderedBySenderAndNumberAndNeverByInsertion) {
  for (const Order order : {Order::fifo, Order::seeded}) {
    const auto expected = arrivals({0, 0, 1, 1}, order);
    ASSERT_EQ(expected.size(), 5u);
    EXPECT_EQ(expected.back(), "task") << "deliveries come before the tasks of their instant";
    EXPECT_EQ(arrivals({1, 0, 1, 0}, order), expected);
    EXPECT_EQ(arrivals({1, 1, 0, 0}, order), expected);
    EXPECT_LT(std::find(expected.begin(), expected.end(), "ada0"), std::find(expected.begin(), expected.end(), "ada1"));
  }
}

TEST(Deliveries, TheLookaheadIsTheLeastLatencyDeclared) {
  TaskRun run;
  EXPECT_EQ(kernel::lookahead(run.scheduler), Duration::max());
  kernel::declare_latency(run.scheduler, Duration::from_ns(500));
  kernel::declare_latency(run.scheduler, Duration::from_ns(300));
  kernel::declare_latency(run.scheduler, Duration::from_ns(400));
  EXPECT_EQ(kernel::lookahead(run.scheduler), Duration::from_ns(300));
}

TEST(DeliveriesDeathTest, ALinkWithoutLatencyIsRefused) {
  TaskRun run;
  EXPECT_DEATH(kernel::declare_latency(run.scheduler, Duration()), "a link between robots has no latency");
}

}  // namespace
}  // namespace waitpoint::kernel
