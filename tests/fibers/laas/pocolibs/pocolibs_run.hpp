// SPDX-License-Identifier: BSD-3-Clause
// A robot's tasks in every order, with pocolibs' clock of 100 ticks per second; C functions by their global names.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "fibers/laas/include/errnoLib.h"
#include "fibers/laas/include/h2errorLib.h"
#include "fibers/laas/include/h2initGlob.h"
#include "fibers/laas/include/taskLib.h"
#include "fibers/laas/include/tickLib.h"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {

/// Runs `body` in every order, with the clock running.
inline void with_clock(const std::function<void()>& body) {
  in_every_order([&] {
    ASSERT_EQ(h2initGlob(100), OK);
    body();
  });
}

/// A task with that name.
inline thread start_task(const char* name, std::function<void()> body) {
  return thread({.name = name}, std::move(body));
}

/// The name of the caller's error code.
inline std::string error_name() { return h2getMsgErrno(errnoGet()); }

inline void sleep_until_tick(int k) { this_thread::sleep_until(Time() + Duration(std::chrono::milliseconds(10)) * k); }

}  // namespace waitpoint
