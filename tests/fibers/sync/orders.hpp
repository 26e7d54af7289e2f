// SPDX-License-Identifier: BSD-3-Clause
// One test body in the default order and in seeded ones: the assertions must hold in all of them.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "fibers/sync/simulation.hpp"

namespace waitpoint {

/// This long after the start.
inline Time at(Duration time) { return Time() + time; }

inline constexpr std::uint64_t seeds_tried = 25;

/// The options of the default order (`number` 0), or of a seeded one.
inline SimulationOptions order_number(std::uint64_t number) {
  return number == 0 ? SimulationOptions() : SimulationOptions{kernel::Order::seeded, number, ""};
}

/// Runs `body` as a simulation of its own in the default order and in seeded ones; each must pass.
inline void in_every_order(const std::function<void()>& body) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    const Report report = simulate(body, order_number(number));
    ASSERT_TRUE(report.passed) << report;
    ASSERT_FALSE(testing::Test::HasFailure()) << "in order " << number;
  }
}

/// Runs `body`, which returns which of two cases occurred, in the default order and in many seeded ones; each must
/// pass, and both cases must occur repeatedly.
inline void expect_both(const std::function<bool()>& body) {
  constexpr std::uint64_t orders = 60;
  int one = 0, other = 0;
  for (std::uint64_t number = 0; number <= orders; ++number) {
    const Report report = simulate([&] { ++(body() ? one : other); }, order_number(number));
    ASSERT_TRUE(report.passed) << report;
    ASSERT_FALSE(testing::Test::HasFailure()) << "in order " << number;
  }
  EXPECT_GT(one, 5);
  EXPECT_GT(other, 5);
}

/// Runs `body` in the default order; it must pass.
inline Report in_order(const std::function<void()>& body) {
  Report report = simulate(body);
  EXPECT_TRUE(report.passed) << report;
  return report;
}

}  // namespace waitpoint
