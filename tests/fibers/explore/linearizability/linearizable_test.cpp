// SPDX-License-Identifier: BSD-3-Clause
// The decision whether a history is linearizable, and its report.
#include "fibers/explore/linearizable.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/fibers/explore/linearizability/histories.hpp"
#include "tests/fibers/explore/linearizability/models.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using models::Fifo, models::Map, models::MapByKeys, models::Register, models::Stack;
using Verdict = Linearizability::Verdict;

template <class Model>
class Decision : public testing::Test {};
using Models = testing::Types<Fifo, Stack, Register, Map, MapByKeys>;
TYPED_TEST_SUITE(Decision, Models);

TYPED_TEST(Decision, IsThatOfTryingAllOrders) {
  std::size_t linearizable_ones = 0, others = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const auto history = histories::random_history<TypeParam>(seed, 7, 3, 6, seed % 2 == 0);
    const Linearizability result = linearizable(history, TypeParam());
    ASSERT_EQ(bool(result), histories::has_linearization(history)) << "seed " << seed << ": " << result;
    ++(result ? linearizable_ones : others);
  }
  EXPECT_GT(linearizable_ones, 50U);
  EXPECT_GT(others, 50U);
}

// Each operation overlaps others.
template <class Model>
void decide_two_hundred(std::size_t clients) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto correct = histories::random_history<Model>(seed, 200, clients, std::nullopt);
    ASSERT_EQ(correct.entries().size(), 200U);
    const Linearizability found = linearizable(correct, Model());
    EXPECT_TRUE(found) << found;
    const auto wrong = histories::random_history<Model>(seed, 200, clients, 20);
    const Linearizability result = linearizable(wrong, Model());
    EXPECT_EQ(result.verdict, Verdict::not_linearizable) << result;
    EXPECT_TRUE(result.picture.bad.has_value()) << result;
  }
}

TEST(Linearizable, TwoHundredOperationsAreDecided) {
  decide_two_hundred<Fifo>(3);
  decide_two_hundred<Stack>(3);
  decide_two_hundred<Register>(8);
  decide_two_hundred<Map>(8);
  decide_two_hundred<MapByKeys>(8);
}

// Operations one after another.
template <class Model>
class Sequence {
 public:
  Sequence& then(models::Operation operation, std::optional<int> result = std::nullopt) {
    history_.record(std::move(operation), [&] { return result; });
    return *this;
  }
  Linearizability check() const { return linearizable(history_, Model()); }

 private:
  History<Model> history_;
};

// The operation that has no place, with its result; empty if the history is linearizable.
std::string bad_one(const Linearizability& result) {
  return result.picture.bad ? result.picture.rows[*result.picture.bad].operation : "";
}

TEST(Linearizable, AStaleReadIsNot) {
  Sequence<Register> history;
  history.then({"write", 1}).then({"read"}, 1).then({"write", 2}).then({"read"}, 1).then({"read"}, 2);
  EXPECT_EQ(bad_one(history.check()), "read -> 1");
}

TEST(Linearizable, ALostElementIsNot) {
  Sequence<Fifo> queue;
  queue.then({"push", 1}).then({"push", 2}).then({"pop"}, 2).then({"pop"});
  EXPECT_EQ(bad_one(queue.check()), "pop -> 2");
  Sequence<Stack> stack;
  stack.then({"push", 1}).then({"push", 2}).then({"pop"}, 2).then({"pop"});
  EXPECT_EQ(bad_one(stack.check()), "pop -> none");
}

TEST(Linearizable, AnElementTakenTwiceIsNot) {
  Sequence<Stack> stack;
  stack.then({"push", 1}).then({"pop"}, 1).then({"pop"}, 1);
  EXPECT_EQ(bad_one(stack.check()), "pop -> 1");
  Sequence<Map> map;
  map.then({"put", 5, 1}).then({"take", 0, 1}, 5).then({"get", 0, 1}, 5);
  EXPECT_EQ(bad_one(map.check()), "get 1 -> 5");
}

// Two pushes that overlap may have been in either order; those that do not have theirs.
TEST(Linearizable, AQueueKeepsTheOrderOfPushesThatDoNotOverlap) {
  for (const bool overlap : {false, true}) {
    History<Fifo> history;
    const std::size_t one = history.invoke({"push", 1});
    if (!overlap) history.respond(one);
    const std::size_t two = history.invoke({"push", 2});
    if (overlap) history.respond(one);
    history.respond(two);
    history.record({"pop"}, [] { return std::optional(2); });
    history.record({"pop"}, [] { return std::optional(1); });
    EXPECT_EQ(bad_one(linearizable(history, Fifo())), overlap ? "" : "pop -> 2");
  }
}

TEST(Linearizable, APendingOperationMayHaveHadItsEffectOnce) {
  const auto popped = [](std::size_t times) {
    History<Fifo> history;
    history.invoke({"push", 1});  // its task was stopped
    history.record({"pop"}, [] { return std::optional<int>(); });
    for (std::size_t i = 0; i < times; ++i) history.record({"pop"}, [] { return std::optional(1); });
    return bad_one(linearizable(history, Fifo()));
  };
  EXPECT_EQ(popped(0), "");
  EXPECT_EQ(popped(1), "");
  EXPECT_EQ(popped(2), "pop -> 1");
}

TEST(Linearizable, OperationEndedByAnExceptionIsPending) {
  History<Stack> history;
  EXPECT_THROW(history.record({"push", 1}, [] { throw 1; }), int);
  EXPECT_FALSE(history.entries().front().result.has_value());
}

TEST(Linearizable, TheKeyWhoseOperationsFailIsNamed) {
  History<MapByKeys> history;
  for (int key = 1; key <= 3; ++key) history.record({"put", 10 * key, key}, [] {});
  history.record({"get", 0, 2}, [] { return std::optional(10); });
  const Linearizability result = linearizable(history, MapByKeys());
  EXPECT_EQ(result.key, "2");
  EXPECT_EQ(result.picture.rows.size(), 2U);
  EXPECT_TRUE(contains(exploration::value_text(result), "operations on key 2:\n")) << result;
}

// Writes of different values that all overlap have as many states as orders; those of different keys have not.
TEST(Linearizable, KeysMakeTheSearchShorter) {
  const auto overlapping = []<class Model>(const Model& model) {
    History<Model> history;
    for (int key = 1; key <= 20; ++key) history.invoke({"put", key, key});
    for (std::size_t i = 0; i < 20; ++i) history.respond(i);
    history.record({"get", 0, 1}, [] { return std::optional(2); });
    return linearizable(history, model, {.configurations_max = 1000});
  };
  const Linearizability whole = overlapping(Map());
  EXPECT_EQ(whole.verdict, Verdict::undecided);
  EXPECT_FALSE(whole);
  EXPECT_TRUE(contains(exploration::value_text(whole), "undecided after 1000 configurations")) << whole;
  EXPECT_EQ(overlapping(MapByKeys()).verdict, Verdict::not_linearizable);
}

// --- the report ---

Linearizability planted() {
  History<Fifo> history;
  const std::size_t push = history.invoke({"push", 1}), pop = history.invoke({"pop"});
  history.respond(push);
  const std::size_t again = history.invoke({"pop"});
  history.respond(pop, 1);
  history.invoke({"push", 3});
  history.respond(again, 1);
  history.record({"push", 2}, [] {});
  return linearizable(history, Fifo());
}

TEST(Linearizable, ATableShowsTheOperationsOverTheEvents) {
  EXPECT_EQ(exploration::value_text(planted()), R"(not linearizable
no place is left for 'pop -> 1' of outside
up to its response the history is linearizable, in the order of the column 'place' (2 operations)
place  task     operation   events
    1  outside  push 1      [-]
    2  outside  pop -> 1     [--]
    !  outside  pop -> 1       [--!
    -  outside  push 3 ...       [--->
    -  outside  push 2             []
                                  ^ end of the prefix)");
}

TEST(Linearizable, ATableShowsTheEventsAroundTheEndOfThePrefix) {
  History<Fifo> history;
  for (int i = 1; i <= 100; ++i) history.record({"push", i}, [] {});
  history.record({"pop"}, [] { return std::optional(2); });
  for (int i = 1; i <= 100; ++i) history.record({"push", i}, [] {});
  const std::string text = exploration::value_text(linearizable(history, Fifo()));
  EXPECT_TRUE(contains(text, "(61 operations responded before these)\n")) << text;
  EXPECT_TRUE(contains(text, "pop -> 2")) << text;
  EXPECT_TRUE(contains(text, "(90 operations were invoked after these)")) << text;
  EXPECT_LT(text.size(), 10'000U);
}

TEST(Linearizable, APictureMarksTheOperationAndThePrefix) {
  const std::string svg = planted().svg();
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg;
  EXPECT_TRUE(contains(svg, ">outside: pop -&gt; 1</text>")) << svg;
  EXPECT_TRUE(contains(svg, "end of the longest linearizable prefix")) << svg;
  EXPECT_EQ(Linearizability().svg(), "");
}

}  // namespace
}  // namespace waitpoint
