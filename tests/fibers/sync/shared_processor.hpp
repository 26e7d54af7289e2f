// SPDX-License-Identifier: BSD-3-Clause
// Threads that share one processor, in tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fibers/sync/threads.hpp"

namespace waitpoint {

/// They log their actions and times, in milliseconds.
struct Shared {
  processor cpu{"cpu"};
  std::string trace;
  std::vector<thread> threads;

  void log(const std::string& what) { trace += what + "@" + std::to_string(now().ns() / 1'000'000) + " "; }
  void add(const char* name, int priority, std::function<void()> body) {
    threads.emplace_back(thread_attributes{.name = name, .on = &cpu, .priority = priority}, std::move(body));
  }
  void join() {
    for (thread& t : threads) t.join();
  }
};

}  // namespace waitpoint
