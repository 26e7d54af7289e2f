// SPDX-License-Identifier: BSD-3-Clause
// A robot's tasks in every order, with pocolibs' clock of 100 ticks per second.
#pragma once

#include "fibers/laas/tickLib.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::laas {

/// The time of tick `k` of a clock of 100 Hz that started at 0.
inline Time tick(std::int64_t k) { return Time() + Duration(std::chrono::milliseconds(10)) * k; }
inline void sleep_until_tick(std::int64_t k) { this_thread::sleep_until(tick(k)); }

/// Runs `body` in every order, with the clock running.
inline void with_clock(const std::function<void()>& body) {
  in_every_order([&] {
    ASSERT_EQ(h2initGlob(100), OK);
    body();
  });
}

}  // namespace waitpoint::laas
