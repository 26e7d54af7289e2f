// SPDX-License-Identifier: BSD-3-Clause
// Classic algorithms hold with their memory orders, and fail with weaker ones in weak memory only. This file is not
// instrumented.
#include "tests/fibers/explore/weak_memory/algorithms.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "fibers/explore/explore.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint::weak_memory {
namespace {

constexpr Order relaxed = std::memory_order_relaxed, acquire = std::memory_order_acquire,
                release = std::memory_order_release, acq_rel = std::memory_order_acq_rel,
                seq_cst = std::memory_order_seq_cst;

ExploreReport explored(const std::function<void()>& body, Memory memory, std::uint64_t iterations = 1500) {
  return explore_with(nullptr, body, {.iterations = iterations, .memory = memory});
}

void holds(const std::function<void()>& body) {
  const ExploreReport report = explored(body, Memory::weak);
  EXPECT_TRUE(report.passed) << report;
}

// In weak memory, and in no other.
void fails(const std::function<void()>& body, const std::string& how) {
  const ExploreReport report = explored(body, Memory::weak, 20'000);
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, how)) << report;
  EXPECT_TRUE(contains(report.text, "reads an older value, as C++ allows for ")) << report;
  const ExploreReport without = explored(body, Memory::sc, 300);
  EXPECT_TRUE(without.passed) << without;
}

TEST(Algorithms, PetersonsLockNeedsSeqCst) {
  fails([] { peterson(release, acquire); }, "two threads are inside");
  fails([] { peterson(seq_cst, acquire); }, "two threads are inside");
  holds([] { peterson(seq_cst, seq_cst); });
}

TEST(Algorithms, DekkersLockNeedsSeqCstFences) {
  fails([] { dekker(acq_rel); }, "two threads are inside");
  holds([] { dekker(seq_cst); });
}

TEST(Algorithms, ASpinlockNeedsARelease) {
  fails([] { spinlock(relaxed); }, "an update is lost");
  holds([] { spinlock(release); });
}

TEST(Algorithms, ASequenceLockNeedsBothFences) {
  fails([] { sequence_lock(relaxed, acquire); }, "half of an update is read");
  fails([] { sequence_lock(release, relaxed); }, "half of an update is read");
  holds([] { sequence_lock(release, acquire); });
}

TEST(Algorithms, AWorkStealingDequeNeedsTheSeqCstFence) {
  fails([] { work_stealing_deque(acq_rel); }, "an element is taken twice");
  holds([] { work_stealing_deque(seq_cst); });
}

TEST(Algorithms, DoubleCheckedLockingNeedsReleaseAndAcquire) {
  holds([] { double_checked_lock(release, acquire); });
  // The construction, plain code, races with the load.
  const auto broken = [](Order publication, Order look) {
    return explore_with(nullptr, [=] { double_checked_lock(publication, look); },
                        {.races = Races::ignore, .memory = Memory::weak});
  };
  EXPECT_TRUE(contains(broken(relaxed, acquire).text, "the settings are read before they are made"));
  EXPECT_TRUE(contains(broken(release, relaxed).text, "the settings are read before they are made"));
}

}  // namespace
}  // namespace waitpoint::weak_memory
