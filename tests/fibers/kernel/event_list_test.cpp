// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/event_list.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/random.hpp"

namespace waitpoint::kernel {
namespace {

struct Reference {
  std::int64_t time;
  std::uint64_t order;
  std::size_t node;
  friend auto operator<=>(const Reference&, const Reference&) = default;
};

// A million random operations beside a sorted reference; `wanted` is about how many events there are.
void compare_with_reference(std::size_t wanted, std::uint64_t operations) {
  const RandomStream random(wanted, "", "operations");
  EventList list(static_cast<std::uint32_t>(2 * wanted));
  std::vector<EventNode> nodes(2 * wanted);
  std::vector<Reference> of(2 * wanted);
  std::set<Reference> reference;
  std::uint64_t drawn = 0;
  const auto below = [&](std::uint64_t bound) { return random.below(bound, ++drawn); };
  const auto new_key = [&](std::size_t node) {
    // Few times, so that many events tie and the order decides.
    of[node] = {static_cast<std::int64_t>(below(wanted / 4 + 2)), make_order(Phase::tasks, drawn), node};
    if (below(8) == 0) of[node].order = make_order(static_cast<Phase>(below(3)), below(tie_mask));
    return EventKey{Time::from_ns(of[node].time), of[node].order};
  };
  const auto node_number = [&](const EventNode& node) { return static_cast<std::size_t>(&node - nodes.data()); };
  for (std::uint64_t i = 0; i < operations; ++i) {
    const std::size_t node = below(nodes.size());
    const bool grow = below(2 * wanted) >= reference.size();
    if (nodes[node].in_list()) {
      reference.erase(of[node]);
      list.remove(nodes[node]);
      ASSERT_FALSE(nodes[node].in_list());
    } else if (grow) {
      list.insert(nodes[node], new_key(node));
      reference.insert(of[node]);
    } else {
      const Reference least = *reference.begin();
      reference.erase(reference.begin());
      ASSERT_EQ(list.least().key.time.ns(), least.time);
      if (below(2) == 0) {
        ASSERT_EQ(node_number(list.pop()), least.node);
      } else {
        const EventKey key = new_key(node);
        ASSERT_EQ(node_number(list.pop_and_insert(nodes[node], key)), least.node);
        reference.insert(of[node]);
      }
      ASSERT_FALSE(nodes[least.node].in_list());
    }
    ASSERT_EQ(list.size(), reference.size());
    ASSERT_TRUE(reference.empty() || node_number(*list.least().node) == reference.begin()->node);
  }
  for (const Reference& next : reference) ASSERT_EQ(node_number(list.pop()), next.node);
  EXPECT_TRUE(list.empty());
}

TEST(EventList, AgreesWithASortedReferenceWhenSmall) { compare_with_reference(6, 300'000); }
TEST(EventList, AgreesWithASortedReferenceWhenMiddling) { compare_with_reference(200, 400'000); }
TEST(EventList, AgreesWithASortedReferenceWhenLarge) { compare_with_reference(5000, 300'000); }

// As in a run: the least event is taken and comes back some time later, others are put in and taken out again; time
// goes on. `increment` says how much later, from a drawn word.
template <class Increment>
void hold_beside_a_reference(std::size_t events, std::uint64_t operations, Increment increment) {
  const RandomStream random(events, "", "hold");
  EventList list(static_cast<std::uint32_t>(2 * events));
  std::vector<EventNode> nodes(2 * events);
  std::vector<Reference> of(2 * events);
  std::set<Reference> reference;
  std::int64_t now = 0;
  std::uint64_t drawn = 0;
  const auto draw = [&] { return random.below(std::uint64_t{1} << 62, ++drawn); };
  const auto put = [&](std::size_t node) {
    of[node] = {now + increment(draw()), make_order(Phase::tasks, ++drawn), node};
    list.insert(nodes[node], {Time::from_ns(of[node].time), of[node].order});
    reference.insert(of[node]);
  };
  for (std::size_t node = 0; node < events; ++node) put(node);
  for (std::uint64_t i = 0; i < operations; ++i) {
    const Reference least = *reference.begin();
    reference.erase(reference.begin());
    now = least.time;
    if (i % 2 == 0) {
      ASSERT_EQ(&list.pop(), &nodes[least.node]) << i;
      put(least.node);
    } else {
      ASSERT_EQ(list.least().node, &nodes[least.node]) << i;
      list.remove(nodes[least.node]);
      put(least.node);
    }
    // A timeout that does not come about.
    const std::size_t timeout = events + draw() % events;
    if (nodes[timeout].in_list()) {
      reference.erase(of[timeout]);
      list.remove(nodes[timeout]);
    } else {
      put(timeout);
    }
    // Now and then most of them go, or come back.
    if (i % 50'000 == 49'999)
      for (std::size_t node = 10; node < events; ++node) {
        if (nodes[node].in_list()) {
          reference.erase(of[node]);
          list.remove(nodes[node]);
        } else {
          put(node);
        }
      }
  }
  while (!reference.empty()) {
    ASSERT_EQ(&list.pop(), &nodes[reference.begin()->node]);
    reference.erase(reference.begin());
  }
  EXPECT_TRUE(list.empty());
}

TEST(EventList, HoldsUniformIncrements) {
  for (const std::size_t events : {20, 300, 5000})
    hold_beside_a_reference(events, 220'000,
                            [](std::uint64_t word) { return static_cast<std::int64_t>(word % 1'000'000); });
}
TEST(EventList, HoldsFarIncrementsAmongNearOnes) {
  for (const std::size_t events : {300, 3000})
    hold_beside_a_reference(events, 220'000, [](std::uint64_t word) {
      return static_cast<std::int64_t>(word % 100 == 0 ? word % 1'000'000'000'000 : word % 1'000);
    });
}
TEST(EventList, HoldsManyEventsOfOneInstant) {
  for (const std::size_t events : {300, 3000})
    hold_beside_a_reference(events, 220'000,
                            [](std::uint64_t word) { return static_cast<std::int64_t>(1000 * (word % 4)); });
}
TEST(EventList, HoldsTimesUpToTheEndOfTime) {
  hold_beside_a_reference(400, 20'000,
                          [](std::uint64_t word) { return static_cast<std::int64_t>(word % (1ull << 47)); });
}

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
  EXPECT_DEATH(list.insert(b, {}), "more events than the event list holds");
  EXPECT_DEATH(list.remove(b), "not in the list");
  EXPECT_DEATH(list.pop_and_insert(a, {}), "put into the list twice");
  list.pop();
  EXPECT_DEATH(list.pop(), "the event list is empty");
}

}  // namespace
}  // namespace waitpoint::kernel
