// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/event_list.hpp"

#include <gtest/gtest.h>

namespace waitpoint::kernel {
namespace {

TEST(EventList, OrdersByTimeThenPhaseThenTie) {
  EventList list(8);
  EventNode nodes[5];
  list.insert(nodes[0], {Time::from_ns(5), make_order(Phase::deliveries, 0)});
  list.insert(nodes[1], {Time::from_ns(4), make_order(Phase::tasks, 9)});
  list.insert(nodes[2], {Time::from_ns(4), make_order(Phase::tasks, 8)});
  list.insert(nodes[3], {Time::from_ns(4), make_order(Phase::world, tie_mask)});
  list.insert(nodes[4], {Time::from_ns(4), make_order(Phase::deliveries, tie_mask)});
  for (const int expected : {4, 3, 2, 1, 0}) EXPECT_EQ(&list.pop(), &nodes[expected]);
}

TEST(EventListDeathTest, MisuseIsABug) {
  EventList list(1);
  EventNode a, b;
  list.insert(a, {});
  EXPECT_DEATH(list.insert(a, {}), "put into the list twice");
  EXPECT_DEATH(list.insert(b, {}), "more events than a run may have pending");
  EXPECT_DEATH(list.remove(b), "not in the list");
  list.pop();
  EXPECT_DEATH(list.pop(), "the event list is empty");
}

}  // namespace
}  // namespace waitpoint::kernel
