// SPDX-License-Identifier: BSD-3-Clause
// The classic litmus tests, with all their outcomes: those that C++20 allows, except where a load would read a later
// store, or a modification order contradict every order of execution. This file is not instrumented.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fibers/explore/weak_memory/executions.hpp"
#include "tests/fibers/explore/weak_memory/outcomes.hpp"

namespace waitpoint::weak_memory {
namespace {

// The outcomes of an exhaustive search; also those of the axioms.
Outcomes outcomes(const Litmus& litmus) {
  const Explored found = explored(litmus, "dpor", Memory::weak);
  EXPECT_EQ(found.text, "") << text_of(litmus);
  EXPECT_TRUE(found.scope.starts_with("all schedules")) << found.scope << text_of(litmus);
  const Outcomes expected = executable(litmus), all = allowed(litmus);
  EXPECT_EQ(found.outcomes, expected) << text_of(litmus) << ": " << text_of(found.outcomes) << "instead of "
                                      << text_of(expected);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), expected.begin(), expected.end())) << text_of(litmus);
  return found.outcomes;
}

bool allows(const Litmus& litmus, const Outcome& outcome) { return outcomes(litmus).contains(outcome); }

const Outcomes all_of_two = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};

// --- two threads, two locations ---

Litmus store_buffering(std::memory_order stores, std::memory_order loads) {
  return {{store(x, 1, stores), load(y, loads)}, {store(y, 1, stores), load(x, loads)}};
}

TEST(Litmus, StoreBufferingNeedsSeqCstForAllFour) {
  EXPECT_EQ(outcomes(store_buffering(relaxed, relaxed)), all_of_two);
  EXPECT_EQ(outcomes(store_buffering(release, acquire)), all_of_two);
  EXPECT_EQ(outcomes(store_buffering(seq_cst, acquire)), all_of_two);
  EXPECT_EQ(outcomes(store_buffering(release, seq_cst)), all_of_two);
  EXPECT_EQ(outcomes(store_buffering(seq_cst, seq_cst)), (Outcomes{{0, 1}, {1, 0}, {1, 1}}));
}

TEST(Litmus, StoreBufferingNeedsSeqCstForBothFences) {
  const auto fenced = [](std::memory_order one, std::memory_order other) -> Litmus {
    return {{store(x, 1, relaxed), fence(one), load(y, relaxed)},
            {store(y, 1, relaxed), fence(other), load(x, relaxed)}};
  };
  EXPECT_EQ(outcomes(fenced(seq_cst, seq_cst)), (Outcomes{{0, 1}, {1, 0}, {1, 1}}));
  EXPECT_EQ(outcomes(fenced(seq_cst, acq_rel)), all_of_two);
  // A fence on one side and seq_cst operations on the other.
  EXPECT_EQ(
      outcomes({{store(x, 1, relaxed), fence(seq_cst), load(y, relaxed)}, {store(y, 1, seq_cst), load(x, seq_cst)}}),
      (Outcomes{{0, 1}, {1, 0}, {1, 1}}));
  EXPECT_EQ(
      outcomes({{store(x, 1, relaxed), fence(seq_cst), load(y, relaxed)}, {store(y, 1, seq_cst), load(x, relaxed)}}),
      all_of_two);
}

TEST(Litmus, StoreBufferingIsPreventedByReadModifyWrites) {
  EXPECT_EQ(outcomes({{store(x, 1, relaxed), add(z, 0, acq_rel), load(y, relaxed)},
                      {store(y, 1, relaxed), add(z, 0, acq_rel), load(x, relaxed)}}),
            (Outcomes{{0, 0, 0, 1, 0}, {0, 1, 0, 0, 0}, {0, 1, 0, 1, 0}}));
  EXPECT_EQ(outcomes({{exchange(x, 1, relaxed), load(y, relaxed)}, {exchange(y, 1, relaxed), load(x, relaxed)}}),
            (Outcomes{{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 1, 0, 0}, {0, 1, 0, 1}}));
}

TEST(Litmus, MessagePassingNeedsReleaseAndAcquire) {
  const auto passed = [](std::memory_order stored, std::memory_order loaded) -> Litmus {
    return {{store(x, 1, relaxed), store(y, 1, stored)}, {load(y, loaded), load(x, relaxed)}};
  };
  const Outcomes ordered = {{0, 0}, {0, 1}, {1, 1}};
  for (const std::memory_order stored : {release, seq_cst})
    for (const std::memory_order loaded : {consume, acquire, seq_cst})
      EXPECT_EQ(outcomes(passed(stored, loaded)), ordered);
  EXPECT_EQ(outcomes(passed(relaxed, acquire)), all_of_two);
  EXPECT_EQ(outcomes(passed(release, relaxed)), all_of_two);
}

TEST(Litmus, MessagePassingByFencesNeedsBoth) {
  const auto fenced = [](std::memory_order released, std::memory_order acquired) -> Litmus {
    return {{store(x, 1, relaxed), fence(released), store(y, 1, relaxed)},
            {load(y, relaxed), fence(acquired), load(x, relaxed)}};
  };
  const Outcomes ordered = {{0, 0}, {0, 1}, {1, 1}};
  EXPECT_EQ(outcomes(fenced(release, acquire)), ordered);
  EXPECT_EQ(outcomes(fenced(acq_rel, seq_cst)), ordered);
  EXPECT_EQ(outcomes(fenced(acquire, acquire)), all_of_two);
  EXPECT_EQ(outcomes(fenced(release, release)), all_of_two);
  EXPECT_EQ(
      outcomes({{store(x, 1, relaxed), fence(release), store(y, 1, relaxed)}, {load(y, acquire), load(x, relaxed)}}),
      ordered);
  EXPECT_EQ(
      outcomes({{store(x, 1, relaxed), store(y, 1, release)}, {load(y, relaxed), fence(acquire), load(x, relaxed)}}),
      ordered);
}

TEST(Litmus, LoadBufferingIsNotShownThoughItIsAllowed) {
  const Litmus litmus = {{load(x, relaxed), store(y, 1, relaxed)}, {load(y, relaxed), store(x, 1, relaxed)}};
  EXPECT_EQ(outcomes(litmus), (Outcomes{{0, 0}, {0, 1}, {1, 0}}));
  EXPECT_TRUE(allowed(litmus).contains({1, 1}));
  EXPECT_FALSE(
      allowed({{load(x, acquire), store(y, 1, release)}, {load(y, acquire), store(x, 1, release)}}).contains({1, 1}));
}

TEST(Litmus, TwoStoresEachInOppositeOrdersAreNotShownThoughTheyAreAllowed) {
  const auto opposite = [](std::memory_order order) -> Litmus {
    return {{store(x, 1, order), store(y, 2, order)}, {store(y, 1, order), store(x, 2, order)}};
  };
  EXPECT_EQ(outcomes(opposite(relaxed)), (Outcomes{{1, 2}, {2, 1}, {2, 2}}));
  EXPECT_TRUE(allowed(opposite(release)).contains({1, 1}));
  EXPECT_FALSE(allowed(opposite(seq_cst)).contains({1, 1}));
}

TEST(Litmus, AStoreBehindAStoreThatAnotherOverwritesIsMissedWithoutSeqCst) {
  const auto overwritten = [](std::memory_order order) -> Litmus {
    return {{store(x, 1, order), store(y, 1, order)},
            {store(y, 2, order), load(x, order == release ? acquire : order)}};
  };
  EXPECT_TRUE(allows(overwritten(release), {0, 2}));
  EXPECT_FALSE(allows(overwritten(seq_cst), {0, 2}));
}

// --- coherence ---

TEST(Litmus, LoadsOfOneThreadNeverGoBack) {
  EXPECT_EQ(outcomes({{store(x, 1, relaxed), store(x, 2, relaxed)}, {load(x, relaxed), load(x, relaxed)}}),
            (Outcomes{{0, 0, 2}, {0, 1, 2}, {0, 2, 2}, {1, 1, 2}, {1, 2, 2}, {2, 2, 2}}));
}

TEST(Litmus, TwoThreadsNeverSeeTwoStoresInOppositeOrders) {
  const Litmus litmus = {{store(x, 1, relaxed)},
                         {store(x, 2, relaxed)},
                         {load(x, relaxed), load(x, relaxed)},
                         {load(x, relaxed), load(x, relaxed)}};
  const Outcomes found = outcomes(litmus);
  for (const int last : {1, 2}) EXPECT_FALSE(found.contains({1, 2, 2, 1, last}));
  EXPECT_TRUE(found.contains({1, 2, 0, 1, 2}));
}

TEST(Litmus, ALoadNeverReadsAStoreBehindIt) {
  EXPECT_EQ(outcomes({{load(x, relaxed), store(x, 1, relaxed)}, {store(x, 2, relaxed)}}),
            (Outcomes{{0, 1}, {0, 2}, {2, 1}}));
}

TEST(Litmus, ALoadNeverReadsAStoreBeforeItsOwnThreads) {
  EXPECT_EQ(outcomes({{store(x, 1, relaxed), load(x, relaxed)}, {store(x, 2, relaxed)}}),
            (Outcomes{{1, 1}, {1, 2}, {2, 2}}));
}

TEST(Litmus, StoresOfOneThreadStayInOrder) {
  EXPECT_EQ(outcomes({{store(x, 1, relaxed), store(x, 2, relaxed)}}), (Outcomes{{2}}));
}

TEST(Litmus, ReadModifyWritesReadTheLastStore) {
  EXPECT_EQ(outcomes({{add(x, 1, relaxed)}, {add(x, 1, relaxed)}, {add(x, 1, relaxed)}}),
            (Outcomes{{0, 1, 2, 3}, {0, 2, 1, 3}, {1, 0, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {2, 1, 0, 3}}));
}

// --- three and four threads ---

TEST(Litmus, CausalityIsTransitiveThroughAcquires) {
  const auto causality = [](std::memory_order loads, std::memory_order stores) -> Litmus {
    return {{store(x, 1, relaxed)}, {load(x, loads), store(y, 1, stores)}, {load(y, loads), load(x, relaxed)}};
  };
  EXPECT_TRUE(allows(causality(relaxed, relaxed), {1, 1, 0}));
  EXPECT_TRUE(allows(causality(acquire, relaxed), {1, 1, 0}));
  EXPECT_TRUE(allows(causality(relaxed, release), {1, 1, 0}));
  EXPECT_FALSE(allows(causality(acquire, release), {1, 1, 0}));
}

TEST(Litmus, ReleaseAndAcquireAreTransitive) {
  const auto chain = [](std::memory_order middle) -> Litmus {
    return {{store(x, 1, relaxed), store(y, 1, release)},
            {load(y, acquire), store(z, 1, middle)},
            {load(z, acquire), load(x, relaxed)}};
  };
  EXPECT_FALSE(allows(chain(release), {1, 1, 0}));
  EXPECT_TRUE(allows(chain(relaxed), {1, 1, 0}));
}

TEST(Litmus, IndependentReadsOfIndependentWritesAgreeBySeqCstAlone) {
  const auto independent = [](std::memory_order stores, std::memory_order loads) -> Litmus {
    return {{store(x, 1, stores)},
            {store(y, 1, stores)},
            {load(x, loads), load(y, loads)},
            {load(y, loads), load(x, loads)}};
  };
  EXPECT_EQ(outcomes(independent(release, acquire)).size(), 16U);
  EXPECT_EQ(outcomes(independent(seq_cst, acquire)).size(), 16U);
  const Outcomes agreed = outcomes(independent(seq_cst, seq_cst));
  EXPECT_EQ(agreed.size(), 15U);
  EXPECT_FALSE(agreed.contains({1, 0, 1, 0}));
}

TEST(Litmus, IndependentReadsOfIndependentWritesAgreeByFences) {
  const auto fenced = [](std::memory_order order) -> Litmus {
    return {{store(x, 1, relaxed)},
            {store(y, 1, relaxed)},
            {load(x, relaxed), fence(order), load(y, relaxed)},
            {load(y, relaxed), fence(order), load(x, relaxed)}};
  };
  EXPECT_FALSE(allows(fenced(seq_cst), {1, 0, 1, 0}));  // since C++20
  EXPECT_TRUE(allows(fenced(acq_rel), {1, 0, 1, 0}));
}

TEST(Litmus, AReleaseSequenceIsContinuedByReadModifyWritesOnly) {
  const auto sequence = [](const Step& middle) -> Litmus {
    return {{store(x, 1, relaxed), store(y, 1, release)}, {middle}, {load(y, acquire), load(x, relaxed)}};
  };
  EXPECT_FALSE(allows(sequence(add(y, 1, relaxed)), {1, 2, 0, 2}));
  EXPECT_TRUE(allows(sequence(store(y, 2, relaxed)), {2, 0, 2}));
  // Not even by a store of the same thread, since C++20.
  EXPECT_TRUE(
      allows({{store(x, 1, relaxed), store(y, 1, release), store(y, 2, relaxed)}, {load(y, acquire), load(x, relaxed)}},
             {2, 0, 2}));
}

TEST(Litmus, AFenceHeadsTheReleaseSequenceOfARelaxedStore) {
  EXPECT_FALSE(allows({{store(x, 1, relaxed), fence(release), store(y, 1, relaxed)},
                       {add(y, 1, relaxed)},
                       {load(y, acquire), load(x, relaxed)}},
                      {1, 2, 0, 2}));
}

// The order of execution is that of the seq_cst operations: y would be read after x, and x before.
TEST(Litmus, AnOrderOfSeqCstOperationsAgainstThatOfExecutionIsNotShown) {
  const Litmus litmus = {{store(x, 1, seq_cst), store(y, 1, relaxed)}, {load(y, relaxed), load(x, seq_cst)}};
  EXPECT_EQ(outcomes(litmus), (Outcomes{{0, 0}, {0, 1}, {1, 1}}));
  EXPECT_TRUE(allowed(litmus).contains({1, 0}));
}

// --- other strategies and sequential consistency ---

TEST(Litmus, IsTheSameByDepthFirstSearch) {
  for (const Litmus& litmus : {Litmus{{store(x, 1, relaxed), store(y, 1, relaxed)}, {load(y, relaxed)}},
                               Litmus{{store(x, 1, relaxed)}, {store(x, 2, relaxed), load(x, relaxed)}}})
    EXPECT_EQ(explored(litmus, "dfs", Memory::weak).outcomes, outcomes(litmus)) << text_of(litmus);
  const Litmus buffering = store_buffering(relaxed, relaxed);
  EXPECT_EQ(explored(buffering, "bounded:2", Memory::weak).outcomes, all_of_two);
}

TEST(Litmus, IsFoundByDrawnSchedules) {
  for (const char* strategy : {"random", "pct", "pos", "urw", "surw", "portfolio"})
    EXPECT_EQ(explored(store_buffering(relaxed, relaxed), strategy, Memory::weak, 500).outcomes, all_of_two)
        << strategy;
}

TEST(Litmus, HasTheOutcomesOfInterleavingsWithoutWeakMemory) {
  EXPECT_EQ(explored(store_buffering(relaxed, relaxed), "dpor", Memory::sc).outcomes,
            (Outcomes{{0, 1}, {1, 0}, {1, 1}}));
}

}  // namespace
}  // namespace waitpoint::weak_memory
