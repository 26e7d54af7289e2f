// SPDX-License-Identifier: BSD-3-Clause
// Robots that communicate over a medium, with functions as their tasks: for tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fibers/io/network.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::io {

inline constexpr Medium two_ms{.latency_least = std::chrono::milliseconds(2),
                               .latency_most = std::chrono::milliseconds(2)};

/// A run with robots of those names and one medium between all of them.
class Fleet {
 public:
  explicit Fleet(const std::vector<std::string>& names, const Medium& medium = two_ms,
                 const SimulationOptions& options = {}, NetworkLimits limits = {})
      : simulation(options), network(simulation, limits) {
    for (const std::string& name : names) robots_[name] = &simulation.add_robot(name);
    network.declare(medium);
  }

  void spawn(const std::string& robot, std::function<void()> body) {
    simulation.spawn(*robots_.at(robot), {.name = "main"}, std::move(body));
  }
  /// Runs to the end; the run must pass.
  void run() {
    ASSERT_EQ(simulation.run_before(Time() + Duration(std::chrono::hours(1))), RunEnd::ended) << simulation.trouble();
  }
  std::string digest(const std::string& robot) const { return to_string(robots_.at(robot)->digest.digest()); }

  Simulation simulation;
  Network network;

 private:
  std::map<std::string, kernel::Robot*> robots_;
};

using waitpoint::in_every_order;

/// In the default order and in seeded ones: makes a fleet, calls `tasks` to spawn its tasks, runs it.
inline void in_every_order(const std::vector<std::string>& names, const Medium& medium,
                           const std::function<void(Fleet&)>& tasks) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    Fleet fleet(names, medium, order_number(number));
    tasks(fleet);
    fleet.run();
    ASSERT_FALSE(testing::Test::HasFailure()) << "in order " << number;
  }
}

}  // namespace waitpoint::io
