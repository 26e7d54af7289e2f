// SPDX-License-Identifier: BSD-3-Clause
// The effects of a medium on its messages: latency, bandwidth, range, loss; and on no others.
#include "fibers/io/medium.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fibers/io/datagram_socket.hpp"
#include "fibers/io/mailbox.hpp"
#include "fibers/io/stream_listener.hpp"
#include "fibers/kernel/messages.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

struct Arrival {
  int number = 0;
  Duration after;  // since it was sent
};

// `count` datagrams of `bytes` each from bob to ada, one every `pace`; the arrivals.
std::vector<Arrival> send_datagrams(Fleet& fleet, int count, Duration pace, std::size_t bytes = 4) {
  std::vector<Arrival> arrived;
  fleet.spawn("ada", [&] {
    datagram_socket in(fleet.network, {.queue_max = 10'000});
    EXPECT_EQ(in.bind("in"), Status::ok);
    int number = 0;
    while (in.receive({reinterpret_cast<std::byte*>(&number), sizeof number}, 10s))
      arrived.push_back({number, now() - (Time() + pace * (number + 1))});
  });
  fleet.spawn("bob", [&, count, pace, bytes] {
    datagram_socket out(fleet.network);
    std::vector<std::byte> message(bytes);
    for (int number = 0; number < count; ++number) {
      this_thread::sleep_until(Time() + pace * (number + 1));
      std::copy_n(reinterpret_cast<const std::byte*>(&number), sizeof number, message.data());
      EXPECT_EQ(out.send_to("ada:in", message), Status::ok);
    }
  });
  fleet.run();
  return arrived;
}

TEST(Medium, AFixedLatencyIsTheSameForAll) {
  Fleet fleet({"ada", "bob"});
  const auto arrived = send_datagrams(fleet, 50, 1ms);
  ASSERT_EQ(arrived.size(), 50u);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(arrived[static_cast<std::size_t>(i)].number, i);
    EXPECT_EQ(arrived[static_cast<std::size_t>(i)].after, Duration(2ms));
  }
  EXPECT_EQ(kernel::lookahead(fleet.simulation.scheduler()), Duration(2ms));
}

TEST(Medium, AnIntervalsLatenciesAreDrawnFromAllOfIt) {
  Fleet fleet({"ada", "bob"}, {.latency_least = 10ms, .latency_most = 30ms});
  const auto arrived = send_datagrams(fleet, 2000, 1ms);
  ASSERT_EQ(arrived.size(), 2000u);
  double sum = 0;
  Duration least = Duration::max(), most;
  bool overtaken = false;
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    least = std::min(least, arrived[i].after);
    most = std::max(most, arrived[i].after);
    sum += arrived[i].after.seconds();
    overtaken = overtaken || (i > 0 && arrived[i].number < arrived[i - 1].number);
  }
  EXPECT_GE(least, Duration(10ms));
  EXPECT_LE(most, Duration(30ms));
  EXPECT_LT(least, Duration(10100us));
  EXPECT_GT(most, Duration(29900us));
  // The mean of 2000 has a standard deviation of 20 ms / sqrt(12 * 2000).
  EXPECT_NEAR(sum / 2000, 0.020, 4 * 0.020 / std::sqrt(12.0 * 2000));
  EXPECT_TRUE(overtaken);
}

TEST(Medium, LossIsDrawnForEachMessageAlone) {
  Fleet fleet({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 1ms, .loss = 0.2});
  const auto arrived = send_datagrams(fleet, 5000, 1ms);
  const LinkStatistics statistics = fleet.network.statistics("bob", "ada");
  EXPECT_EQ(statistics.sent, 5000u);
  EXPECT_EQ(statistics.lost + arrived.size(), 5000u);
  EXPECT_NEAR(static_cast<double>(statistics.lost), 1000, 4 * std::sqrt(5000 * 0.2 * 0.8));
  // Losses are independent of each other.
  std::vector<bool> lost(5000, true);
  for (const Arrival& arrival : arrived) lost[static_cast<std::size_t>(arrival.number)] = false;
  int both = 0;
  for (std::size_t i = 1; i < lost.size(); ++i) both += lost[i - 1] && lost[i];
  EXPECT_NEAR(both, 200, 4 * std::sqrt(5000 * 0.04 * 0.96));
}

TEST(Medium, LossAndLatencyDependOnTheSeed) {
  const Medium medium{.latency_least = 1ms, .latency_most = 9ms, .loss = 0.5};
  const auto numbers = [&](std::uint64_t seed) {
    Fleet fleet({"ada", "bob"}, medium, {kernel::Order::fifo, seed, ""});
    std::vector<std::int64_t> result;
    for (const Arrival& arrival : send_datagrams(fleet, 40, 1ms))
      result.insert(result.end(), {arrival.number, arrival.after.ns()});
    return result;
  };
  EXPECT_EQ(numbers(1), numbers(1));
  EXPECT_NE(numbers(1), numbers(2));
}

TEST(Medium, MessagesQueueBehindEachOtherOnABandwidth) {
  Fleet fleet({"ada", "bob"}, {.latency_least = 2ms, .latency_most = 2ms, .bandwidth_bit_s = 80'000});
  // 100 bytes take 10 ms, and one datagram comes every millisecond.
  const auto arrived = send_datagrams(fleet, 5, 1ms, 100);
  ASSERT_EQ(arrived.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(arrived[static_cast<std::size_t>(i)].after, Duration(12ms) + i * Duration(9ms));
}

TEST(Medium, DatagramsThatFindTheQueueTooLongAreDroppedAndCounted) {
  Fleet fleet({"ada", "bob"},
              {.latency_least = 2ms, .latency_most = 2ms, .bandwidth_bit_s = 80'000, .queue_bytes = 300});
  const auto arrived = send_datagrams(fleet, 20, 1us, 100);
  EXPECT_EQ(arrived.size(), 4u) << "one on the air and three that wait";
  EXPECT_EQ(fleet.network.statistics("bob", "ada").overflowed, 16u);
}

TEST(Medium, EachDirectionOfEachPairHasABandwidthOfItsOwn) {
  Fleet fleet({"ada", "bob", "eve"}, {.latency_least = 1ms, .latency_most = 1ms, .bandwidth_bit_s = 8'000});
  std::vector<Time> times;
  for (const char* to : {"ada", "eve"}) {
    fleet.spawn(to, [&] {
      datagram_socket s(fleet.network);
      EXPECT_EQ(s.bind("in"), Status::ok);
      EXPECT_EQ(s.send_to("bob:in", bytes_of("x")), Status::ok);
      EXPECT_TRUE(s.receive({}));
      times.push_back(now());
    });
    fleet.spawn("bob", [&, to] {
      EXPECT_EQ(datagram_socket(fleet.network).send_to(Address(to, "in"), bytes_of("x")), Status::ok);
    });
  }
  fleet.run();
  EXPECT_EQ(times, (std::vector<Time>{at(2ms), at(2ms)}));
}

TEST(Medium, LatencyGrowsWithTheDistanceAtTheSending) {
  Fleet fleet({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 1ms, .latency_per_metre = Duration(100us)});
  // Bob drives away at 1 m/s.
  fleet.network.set_distance([&](const std::string& from, const std::string& to) {
    EXPECT_TRUE((from == "bob" && to == "ada") || (from == "ada" && to == "bob"));
    return fleet.simulation.global_time().seconds();
  });
  const auto arrived = send_datagrams(fleet, 10, 1s);
  ASSERT_EQ(arrived.size(), 10u);
  for (const Arrival& arrival : arrived)
    EXPECT_EQ(arrival.after, Duration(1ms) + (arrival.number + 1) * Duration(100us));
}

TEST(Medium, BeyondTheRangeDatagramsAreLost) {
  Fleet fleet({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 1ms, .range_m = 30});
  fleet.network.set_distance([&](auto&, auto&) { return 10 * fleet.simulation.global_time().seconds(); });
  const auto arrived = send_datagrams(fleet, 10, 1s);
  EXPECT_EQ(arrived.size(), 3u) << "at 10, 20 and exactly 30 m";
  EXPECT_EQ(fleet.network.statistics("bob", "ada").out_of_range, 7u);
}

// The loss of a datagram is decided when it is sent, before it could arrive.
TEST(Medium, LossAndRangeAreDecidedAtTheSending) {
  Fleet fleet({"ada", "bob", "eve"}, {.latency_least = 1s, .latency_most = 1s, .range_m = 30, .loss = 0.5});
  double distance_m = 31;
  fleet.network.set_distance([&](auto&, auto&) { return distance_m; });
  int arrived = 0;
  fleet.spawn("ada", [&] {
    datagram_socket in(fleet.network);
    EXPECT_EQ(in.bind("in"), Status::ok);
    while (in.receive({}, 5s)) ++arrived;
  });
  fleet.spawn("bob", [&] {
    datagram_socket out(fleet.network);
    EXPECT_EQ(out.send_to("ada:in", {}), Status::ok);
    EXPECT_EQ(fleet.network.statistics("bob", "ada").out_of_range, 1u);
    distance_m = 29;  // too late for the first
    for (int i = 0; i < 40; ++i) EXPECT_EQ(out.send_to("ada:in", {}), Status::ok);
    distance_m = 31;  // too late to have an effect
    EXPECT_EQ(now(), Time());
    const LinkStatistics sent = fleet.network.statistics("bob", "ada");
    EXPECT_EQ(sent.sent, 41u);
    EXPECT_GT(sent.lost, 10u);
    EXPECT_LT(sent.lost, 30u);
    sleep_for(2s);
    EXPECT_EQ(fleet.network.statistics("bob", "ada").lost, sent.lost);
    EXPECT_EQ(static_cast<std::uint64_t>(arrived), 40 - sent.lost);
  });
  fleet.run();
}

TEST(Medium, BeyondTheRangeStreamsWaitAndLoseNothing) {
  in_every_order({"ada", "bob"},
                 {.latency_least = 1ms, .latency_most = 5ms, .range_m = 30, .loss = 1, .range_check = 20ms},
                 [](Fleet& fleet) {
                   // In range from 100 ms, out of range from 200 ms, in range again from 500 ms.
                   fleet.network.set_distance([&](auto&, auto&) {
                     const double t_s = fleet.simulation.global_time().seconds();
                     return t_s < 0.1 || (t_s > 0.2 && t_s < 0.5) ? 31.0 : 5.0;
                   });
                   fleet.spawn("ada", [&] {
                     stream_listener door(fleet.network);
                     EXPECT_EQ(door.listen("door"), Status::ok);
                     Result<stream_socket> socket = door.accept();
                     EXPECT_GE(now(), at(101ms));
                     EXPECT_LE(now(), at(125ms)) << "range is looked at every 20 ms";
                     EXPECT_EQ(read_all(*socket), "before-while-after");
                     EXPECT_GE(now(), at(601ms));
                   });
                   fleet.spawn("bob", [&] {
                     Result<stream_socket> socket = io::connect(fleet.network, "ada:door");
                     ASSERT_TRUE(socket);
                     EXPECT_TRUE(socket->write(bytes_of("before-")));
                     this_thread::sleep_until(at(300ms));
                     EXPECT_TRUE(socket->write(bytes_of("while-")));
                     this_thread::sleep_until(at(600ms));
                     EXPECT_TRUE(socket->write(bytes_of("after")));
                   });
                 });
}

TEST(Medium, ConnectingBeyondTheRangeTimesOut) {
  Fleet fleet({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 1ms, .range_m = 30});
  fleet.network.set_distance([](auto&, auto&) { return 31.0; });
  fleet.spawn("bob", [&] {
    EXPECT_EQ(io::connect(fleet.network, "ada:door", 1s).status(), Status::timed_out);
    EXPECT_EQ(now(), at(1s));
  });
  fleet.run();
}

TEST(Medium, APairOfRobotsMayHaveOneOfItsOwn) {
  Fleet fleet({"ada", "bob", "eve"});
  fleet.network.declare("bob", "ada", {.latency_least = 500us, .latency_most = 500us});
  EXPECT_EQ(kernel::lookahead(fleet.simulation.scheduler()), Duration(500us));
  std::vector<Time> times;
  for (const char* to : {"ada", "eve"})
    fleet.spawn(to, [&] {
      datagram_socket s(fleet.network);
      EXPECT_EQ(s.bind("in"), Status::ok);
      EXPECT_TRUE(s.receive({}));
      times.push_back(now());
    });
  fleet.spawn("bob", [&] {
    datagram_socket s(fleet.network);
    for (const char* to : {"ada:in", "eve:in"}) EXPECT_EQ(s.send_to(to, {}), Status::ok);
  });
  fleet.run();
  EXPECT_EQ(times, (std::vector<Time>{at(500us), at(2ms)}));
}

TEST(Medium, WithoutOneThereIsNoRoute) {
  Simulation simulation;
  Network network(simulation);
  simulation.add_robot("ada");
  simulation.spawn(simulation.add_robot("bob"), {}, [&] {
    EXPECT_EQ(datagram_socket(network).send_to("ada:in", {}), Status::no_route);
    EXPECT_EQ(io::connect(network, "ada:door").status(), Status::no_route);
  });
  EXPECT_EQ(simulation.run_before(), RunEnd::ended);
  EXPECT_EQ(kernel::lookahead(simulation.scheduler()), Duration::max());
}

TEST(Medium, OneThatMakesNoSenseIsBadInput) {
  Simulation simulation;
  Network network(simulation);
  simulation.add_robot("ada");
  const auto message = [&](const Medium& medium) {
    try {
      network.declare(medium);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_EQ(message({}), "taken");
  EXPECT_EQ(message({.latency_least = 0ms}),
            "medium: expected a positive latency: no robot may affect another at the same instant");
  EXPECT_EQ(message({.latency_least = 3ms, .latency_most = 2ms}),
            "medium: expected a least latency of at most the greatest");
  EXPECT_EQ(message({.latency_per_metre = -1ms}), "medium: expected a latency per metre from 0 to 1 s");
  EXPECT_EQ(message({.range_m = 0}), "medium: expected a positive range");
  EXPECT_EQ(message({.loss = 1.5}), "medium: expected a loss from 0 to 1");
  EXPECT_EQ(message({.loss = std::nan("")}), "medium: expected a loss from 0 to 1");
  EXPECT_THROW(network.declare("ada", "nobody", {}), BadInput);
  EXPECT_THROW(network.declare("ada", "ada", {}), BadInput);
}

TEST(Network, MayGoBeforeARunThatIsBrokenOff) {
  Simulation simulation;
  Network network(simulation);
  network.declare(two_ms);
  simulation.add_robot("bob");
  simulation.spawn(simulation.add_robot("ada"), {}, [&] {
    mailbox<int> box(1);
    EXPECT_EQ(box.bind(network, "box"), Status::ok);
    stream_listener door(network);
    EXPECT_EQ(door.listen("door"), Status::ok);
    Result<stream_socket> a = io::connect(network, "door"), b = door.accept();
    datagram_socket socket(network);
    for (int i = 0; i < 5; ++i, sleep_for(1ms)) EXPECT_EQ(socket.send_to("bob:in", bytes_of("x")), Status::ok);
    (void)io::connect(network, "bob:door");
    ADD_FAILURE();
  });
  EXPECT_EQ(simulation.run_before(at(8ms)), RunEnd::time_reached);
}

TEST(MediumDeathTest, MessagesUnderWayAreBounded) {
  EXPECT_DEATH(
      {
        Fleet fleet({"ada", "bob"}, two_ms, {}, {.in_flight_max = 100});
        send_datagrams(fleet, 1000, Duration(1us));
      },
      "more messages in transit between two robots than NetworkLimits::in_flight_max");
}

}  // namespace
}  // namespace waitpoint::io
