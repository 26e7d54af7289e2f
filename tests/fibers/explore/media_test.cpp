// SPDX-License-Identifier: BSD-3-Clause
// The effects of a medium are choices, too: the datagrams that are lost, and their latencies.
#include <gtest/gtest.h>

#include <set>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/io/datagram_socket.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// The possible arrivals of two letters, a and b, sent a millisecond apart.
std::set<std::string> arrivals(const io::Medium& medium) {
  std::set<std::string> found;
  SimulationOptions options;
  options.order = kernel::Order::explored;
  const auto strategy = exploration::make_strategy("random");
  for (std::uint64_t number = 0; number < 300; ++number) {
    io::Fleet fleet({"ada", "bob"}, medium, options);
    exploration::Explorer explorer(fleet.simulation.scheduler(), 100'000);
    strategy->begin(number, exploration::Draws(1, "random", number), {});
    explorer.begin(*strategy);
    kernel::set_decisions(fleet.simulation.scheduler(), explorer);
    std::string came;
    fleet.spawn("ada", [&] {
      io::datagram_socket in(fleet.network);
      EXPECT_EQ(in.bind("in"), io::Status::ok);
      char letter = 0;
      while (in.receive({reinterpret_cast<std::byte*>(&letter), 1}, 1s)) came += letter;
    });
    fleet.spawn("bob", [&] {
      io::datagram_socket out(fleet.network);
      for (const char letter : {'a', 'b'}) {
        this_thread::sleep_for(1ms);
        EXPECT_EQ(out.send_to("ada:in", {reinterpret_cast<const std::byte*>(&letter), 1}), io::Status::ok);
      }
    });
    fleet.run();
    found.insert(came);
  }
  return found;
}

TEST(ExploredMedia, LossAndLatenessAreChosen) {
  const std::set<std::string> in_time = {"ab"};
  EXPECT_EQ(arrivals({.latency_least = 1ms, .latency_most = 1ms}), in_time);
  const std::set<std::string> late = {"ab", "ba"};
  EXPECT_EQ(arrivals({.latency_least = 1ms, .latency_most = 5ms}), late);
  const std::set<std::string> lost = {"ab", "a", "b", ""};
  EXPECT_EQ(arrivals({.latency_least = 1ms, .latency_most = 1ms, .loss = 0.001}), lost);
}

}  // namespace
}  // namespace waitpoint
