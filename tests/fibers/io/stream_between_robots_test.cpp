// SPDX-License-Identifier: BSD-3-Clause
// Streams over a medium: the calls that take a round trip, and the bounds on data under way.
#include <gtest/gtest.h>

#include "fibers/io/stream_listener.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

constexpr Medium jittery{.latency_least = Duration(1ms), .latency_most = Duration(30ms)};

TEST(StreamSocket, ConnectingTakesARoundTripAndSoDoesRoomInTheBuffer) {
  in_every_order({"ada", "bob"}, two_ms, [](Fleet& fleet) {
    fleet.spawn("ada", [&] {
      stream_listener door(fleet.network, {.stream = {.buffer_bytes = 100}});
      EXPECT_EQ(door.listen("door"), Status::ok);
      Result<stream_socket> socket = door.accept();
      EXPECT_EQ(now(), at(3ms));
      EXPECT_EQ(socket->peer_robot(), "bob");
      EXPECT_EQ(read_text(*socket, 100), long_text(100));
      EXPECT_EQ(now(), at(7ms));
      EXPECT_EQ(read_all(*socket), "more");
      EXPECT_EQ(now(), at(11ms));
    });
    fleet.spawn("bob", [&] {
      EXPECT_EQ(io::connect(fleet.network, "ada:window", 500us).status(), Status::timed_out);
      sleep_for(500us);
      Result<stream_socket> socket = io::connect(fleet.network, "ada:door");
      ASSERT_TRUE(socket);
      EXPECT_EQ(now(), at(5ms));
      EXPECT_TRUE(socket->write(bytes_of(long_text(100))));
      EXPECT_EQ(now(), at(5ms));
      EXPECT_TRUE(socket->write(bytes_of("more")));
      EXPECT_EQ(now(), at(9ms)) << "word that there is room took its time";
    });
  });
}

TEST(StreamSocket, KeepsItsOrderWhateverTheLatency) {
  in_every_order({"ada", "bob"}, jittery, [](Fleet& fleet) {
    const std::string text = long_text(20'000);
    fleet.spawn("ada", [&, text] {
      stream_listener door(fleet.network, {.stream = {.buffer_bytes = 5000}});
      EXPECT_EQ(door.listen("door"), Status::ok);
      Result<stream_socket> socket = door.accept();
      EXPECT_EQ(read_all(*socket, 333), text);
    });
    fleet.spawn("bob", [&, text] {
      Result<stream_socket> socket = io::connect(fleet.network, "ada:door");
      ASSERT_TRUE(socket);
      for (std::size_t sent = 0; sent < text.size(); sent += 400) {
        EXPECT_TRUE(socket->write(bytes_of(text).subspan(sent, 400)));
        sleep_for(300us);
      }
    });
  });
}

TEST(StreamSocket, AClientThatGivesUpLeavesNoServerWaiting) {
  in_every_order({"ada", "bob"}, two_ms, [](Fleet& fleet) {
    fleet.spawn("ada", [&] {
      stream_listener door(fleet.network);
      EXPECT_EQ(door.listen("door"), Status::ok);
      Result<stream_socket> socket = door.accept();
      EXPECT_EQ(read_text(*socket), "[end of file]");
      EXPECT_EQ(now(), at(6ms)) << "the answer has come back unread";
      EXPECT_EQ(socket->write(bytes_of("x")).status(), Status::peer_closed);
    });
    fleet.spawn("bob", [&] {
      EXPECT_EQ(io::connect(fleet.network, "ada:door", 3ms).status(), Status::timed_out);
      EXPECT_EQ(now(), at(3ms));
    });
  });
}

TEST(StreamSocket, RefusedTakesARoundTripToo) {
  Fleet fleet({"ada", "bob"});
  fleet.spawn("bob", [&] {
    EXPECT_EQ(io::connect(fleet.network, "ada:door").status(), Status::refused);
    EXPECT_EQ(now(), at(4ms));
    EXPECT_EQ(io::connect(fleet.network, "ada:door", no_wait).status(), Status::would_block);
  });
  fleet.run();
}

TEST(StreamSocket, BoundsMessagesInFlight) {
  Fleet fleet({"ada", "bob"}, two_ms, {}, {.in_flight_max = 100'000});
  fleet.spawn("ada", [&] {
    stream_listener door(fleet.network);
    EXPECT_EQ(door.listen("door"), Status::ok);
    Result<stream_socket> socket = door.accept();
    sleep_for(1s);
    EXPECT_EQ(read_all(*socket, 1000).size(), 5000u);
  });
  fleet.spawn("bob", [&] {
    Result<stream_socket> socket = io::connect(fleet.network, "ada:door");
    ASSERT_TRUE(socket);
    std::size_t sent = 0;
    while (socket->write(bytes_of("x"), no_wait)) ++sent;
    EXPECT_EQ(sent, buffer_default / least_charge);
    for (; sent < 5000; ++sent) EXPECT_TRUE(socket->write(bytes_of("x")));
  });
  fleet.run();
}

}  // namespace
}  // namespace waitpoint::io
