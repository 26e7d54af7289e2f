// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/stream_socket.hpp"

#include <gtest/gtest.h>

#include "fibers/io/poll.hpp"
#include "fibers/io/stream_listener.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// Two ends of a connection within one robot.
struct Connected {
  explicit Connected(const StreamOptions& options = {}) : listener(network, {.stream = options}) {
    EXPECT_EQ(listener.listen("door"), Status::ok);
    Result<stream_socket> connected = io::connect(network, "door", no_wait, options);
    EXPECT_TRUE(connected);
    client = std::move(*connected);
    server = std::move(*listener.accept(no_wait));
  }
  Network network;
  stream_listener listener;
  stream_socket client, server;
};

TEST(StreamSocket, CarriesBytesBothWaysWithinARobotAtOnce) {
  in_every_order([] {
    Connected c;
    EXPECT_EQ(c.client.write(bytes_of("question")).value(), 8u);
    EXPECT_EQ(read_text(c.server), "question");
    EXPECT_EQ(c.server.write(bytes_of("answer")).value(), 6u);
    EXPECT_EQ(read_text(c.client, 3), "ans");
    EXPECT_EQ(read_text(c.client), "wer");
    EXPECT_EQ(c.client.peer_robot(), "environment");
    EXPECT_EQ(now(), Time());
  });
}

TEST(StreamSocket, HoldsAWriterUpWhenTheOtherSidesBufferIsFull) {
  in_every_order([] {
    Connected c({.buffer_bytes = 100});
    const Result<std::size_t> first = c.client.write(bytes_of(long_text(150)), no_wait);
    EXPECT_EQ(first.status(), Status::would_block);
    EXPECT_EQ(first.value(), 100u);
    EXPECT_EQ(c.client.write(bytes_of("x"), 5ms).status(), Status::timed_out);
    EXPECT_EQ(now(), at(5ms));
    thread reader([&] {
      sleep_for(1ms);
      EXPECT_EQ(read_text(c.server, 100), long_text(100));
      EXPECT_EQ(read_all(c.server), "rest");
    });
    EXPECT_EQ(c.client.write(bytes_of("rest"), 2ms).value(), 4u);
    EXPECT_EQ(now(), at(6ms));
    c.client.close();
    reader.join();
  });
}

TEST(StreamSocket, TimesOutAtTheDeadlineAndReadsInTime) {
  in_every_order([] {
    Connected c;
    EXPECT_EQ(read_text(c.server, 9, no_wait), "[would block]");
    EXPECT_EQ(read_text(c.server, 9, 5ms), "[timed out]");
    EXPECT_EQ(now(), at(5ms));
    thread other([&] {
      sleep_for(2ms);
      EXPECT_TRUE(c.client.write(bytes_of("x")));
    });
    EXPECT_EQ(read_text(c.server, 9, 3ms), "x");
    EXPECT_EQ(now(), at(7ms));
    other.join();
    EXPECT_EQ(c.listener.accept(1ms).status(), Status::timed_out);
    EXPECT_EQ(now(), at(8ms));
  });
}

TEST(StreamSocket, WrittenAtTheInstantOfTheDeadlineNothingIsLost) {
  expect_both([] {
    Connected c;
    std::string text;
    thread other([&] { text = read_text(c.server, 9, 5ms); });
    sleep_for(5ms);
    EXPECT_TRUE(c.client.write(bytes_of("x")));
    other.join();
    EXPECT_EQ(read_text(c.server, 9, no_wait), text == "x" ? "[would block]" : "x");
    return text == "x";
  });
}

TEST(StreamSocket, HalfCloseEndsOneDirectionOnly) {
  in_every_order([] {
    Connected c;
    EXPECT_TRUE(c.client.write(bytes_of("all I say")));
    c.client.shutdown_write();
    EXPECT_EQ(read_all(c.server), "all I say");
    EXPECT_TRUE(c.server.write(bytes_of("I hear")));
    EXPECT_EQ(read_text(c.client), "I hear");
    c.server.close();
    EXPECT_EQ(read_text(c.client), "[end of file]");
  });
}

TEST(StreamSocket, DataBeforeThePeersCloseIsReadAndWritesFail) {
  in_every_order([] {
    Connected c({.buffer_bytes = 8});
    EXPECT_TRUE(c.client.write(bytes_of("the last")));
    thread writer([&] {
      const Result<std::size_t> cut = c.server.write(bytes_of("much too much"));
      EXPECT_EQ(cut.status(), Status::peer_closed);
      EXPECT_EQ(cut.value(), 8u);
      EXPECT_EQ(now(), at(1ms));
    });
    sleep_for(1ms);
    c.client.close();
    writer.join();
    EXPECT_EQ(read_all(c.server), "the last");
    EXPECT_EQ(c.server.write(bytes_of("x")).status(), Status::peer_closed);
  });
}

TEST(StreamSocket, CloseWakesWaitersAndPollersAtThisEnd) {
  in_every_order([] {
    Connected c({.buffer_bytes = 1});
    EXPECT_TRUE(c.client.write(bytes_of("x")));
    PollEntry entries[] = {{c.client, Events::readable | Events::writable},
                           {c.server, Events::readable | Events::writable},
                           {c.listener, Events::readable}};
    EXPECT_EQ(poll(entries, no_wait).value(), 1u);
    EXPECT_EQ(entries[1].ready, Events::readable | Events::writable);
    thread reader([&] { EXPECT_EQ(read_text(c.client), "[closed]"); });
    thread writer([&] { EXPECT_EQ(c.client.write(bytes_of("y")).status(), Status::closed); });
    thread accepter([&] { EXPECT_EQ(c.listener.accept().status(), Status::closed); });
    sleep_for(1ms);
    c.client.close();
    c.listener.close();
    EXPECT_EQ(poll(entries).value(), 3u);
    for (const PollEntry& entry : entries) EXPECT_TRUE(any(entry.ready & Events::closed));
    reader.join();
    writer.join();
    accepter.join();
  });
}

TEST(StreamSocket, FailureToConnectIsAReturnValue) {
  in_every_order([] {
    Network network;
    EXPECT_EQ(io::connect(network, "door").status(), Status::refused) << "nobody listens";
    EXPECT_EQ(io::connect(network, "nobody:door").status(), Status::no_route);
    stream_listener door(network, {.backlog = 2}), second(network);
    EXPECT_EQ(door.listen("door"), Status::ok);
    EXPECT_EQ(second.listen("door"), Status::address_in_use);
    Result<stream_socket> a = io::connect(network, "door"), b = io::connect(network, "door");
    EXPECT_TRUE(a && b);
    EXPECT_EQ(io::connect(network, "door").status(), Status::refused) << "the backlog is full";
    door.close();
    EXPECT_EQ(read_text(*a), "[end of file]") << "nobody accepted it";
    EXPECT_EQ(second.listen("door"), Status::ok);
    EXPECT_EQ(now(), Time());
  });
}

TEST(StreamSocketDeathTest, MisuseIsABug) {
  EXPECT_DEATH(simulate([] {
                 Connected c;
                 c.client.close();
                 (void)c.client.write(bytes_of("x"));
               }),
               "a stream socket is used after its close");
  EXPECT_DEATH(simulate([] {
                 Connected c;
                 c.client.shutdown_write();
                 (void)c.client.write(bytes_of("x"));
               }),
               "written to after shutdown_write");
  EXPECT_DEATH(simulate([] {
                 Network network;
                 stream_listener listener(network);
                 (void)listener.accept();
               }),
               "a listener accepts before it listens");
  EXPECT_DEATH(simulate([] {
                 Network network;
                 stream_listener listener(network);
                 (void)listener.listen("a");
                 (void)listener.listen("b");
               }),
               "listens a second time");
  EXPECT_DEATH(
      {
        Fleet fleet({"ada", "bob"});
        stream_listener listener;
        fleet.spawn("ada", [&] {
          listener = stream_listener(fleet.network);
          (void)listener.listen("door");
          sleep_for(5ms);
        });
        fleet.spawn("bob", [&] {
          sleep_for(1ms);
          (void)listener.accept();
        });
        fleet.run();
      },
      "used by a task of another robot");
}

}  // namespace
}  // namespace waitpoint::io
