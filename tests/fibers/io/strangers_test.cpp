// SPDX-License-Identifier: BSD-3-Clause
// Messages over a medium affect only the robots that exchange them; the windows of a run affect none.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/io/datagram_socket.hpp"
#include "fibers/io/stream_listener.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// Bob and ada communicate by all means; `strangers` communicate among each other, and start before them.
std::vector<std::string> digests(std::uint64_t number, int strangers, bool strangers_first = true) {
  std::vector<std::string> names = {"ada", "bob"};
  for (int i = 0; i < strangers; ++i)
    names.insert(strangers_first ? names.begin() : names.end(), "stranger" + std::to_string(i));
  Fleet fleet(names, {.latency_least = 1ms, .latency_most = 3ms, .bandwidth_bit_s = 10'000'000, .loss = 0.1},
              order_number(number));
  const auto talk = [&fleet](const std::string& from, const std::string& to) {
    fleet.spawn(to, [&fleet] {
      stream_listener door(fleet.network);
      EXPECT_EQ(door.listen("door"), Status::ok);
      datagram_socket in(fleet.network);
      EXPECT_EQ(in.bind("in"), Status::ok);
      Result<stream_socket> socket = door.accept();
      EXPECT_EQ(read_all(*socket).size(), 1500u);
      while (in.receive({}, 4ms)) sleep_for(100us);
    });
    fleet.spawn(from, [&fleet, to] {
      datagram_socket out(fleet.network);
      Result<stream_socket> socket = io::connect(fleet.network, Address(to, "door"));
      for (int i = 0; i < 30; ++i) {
        EXPECT_TRUE(socket->write(bytes_of(long_text(50))));
        EXPECT_EQ(out.send_to(Address(to, "in"), bytes_of("x")), Status::ok);
        sleep_for(250us);
      }
    });
  };
  if (strangers_first)
    for (int i = 0; i < strangers; i += 2) talk("stranger" + std::to_string(i), "stranger" + std::to_string(i + 1));
  talk("bob", "ada");
  if (!strangers_first)
    for (int i = 0; i < strangers; i += 2) talk("stranger" + std::to_string(i), "stranger" + std::to_string(i + 1));
  fleet.run();
  return {fleet.digest("ada"), fleet.digest("bob")};
}

TEST(Medium, TheSameSeedGivesTheSameRun) {
  for (std::uint64_t number = 0; number <= 5; ++number) EXPECT_EQ(digests(number, 4), digests(number, 4));
  EXPECT_NE(digests(1, 0), digests(2, 0));
}

TEST(Medium, RobotsThatDoNotTalkToOneAreNotNoticedByIt) {
  for (std::uint64_t number = 0; number <= 5; ++number) {
    const auto alone = digests(number, 0);
    EXPECT_EQ(digests(number, 2), alone);
    EXPECT_EQ(digests(number, 8), alone);
    EXPECT_EQ(digests(number, 8, false), alone);
  }
}

TEST(Medium, WindowsDoNotChangeARun) {
  const auto run = [](Duration width) {
    Fleet fleet({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 9ms, .loss = 0.2});
    fleet.spawn("ada", [&] {
      datagram_socket in(fleet.network);
      EXPECT_EQ(in.bind("in"), Status::ok);
      while (in.receive({}, 20ms)) {
      }
    });
    fleet.spawn("bob", [&] {
      datagram_socket out(fleet.network);
      for (int i = 0; i < 100; ++i, sleep_for(200us)) EXPECT_EQ(out.send_to("ada:in", {}), Status::ok);
    });
    for (Time until = Time() + width; fleet.simulation.run_before(until) == RunEnd::time_reached;) until += width;
    return fleet.digest("ada");
  };
  const std::string whole = run(Duration(1h));
  for (const auto width : {100us, 333us, 1000us}) EXPECT_EQ(run(width), whole);
}

}  // namespace
}  // namespace waitpoint::io
