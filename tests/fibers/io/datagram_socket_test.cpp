// SPDX-License-Identifier: BSD-3-Clause
// Datagrams within a robot, without a medium; media: medium_test.cpp.
#include "fibers/io/datagram_socket.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "fibers/io/poll.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

struct Received {
  Status status;
  std::string text;
  Datagram datagram;
};

template <class... Until>
Received receive(datagram_socket& socket, std::size_t room, const Until&... until) {
  std::string text(room, '?');
  const Result<Datagram> got = socket.receive({reinterpret_cast<std::byte*>(text.data()), room}, until...);
  text.resize(got.value().size);
  return {got.status(), text, got.value()};
}

TEST(DatagramSocket, KeepsBoundariesAndTellsTheSenderAndWhatWasCut) {
  in_every_order([] {
    Network network;
    datagram_socket a(network), b(network), nameless(network);
    EXPECT_EQ(a.bind("a"), Status::ok);
    EXPECT_EQ(b.bind("b"), Status::ok);
    EXPECT_EQ(a.send_to("b", bytes_of("one")), Status::ok);
    EXPECT_EQ(a.send_to("environment:b", bytes_of("")), Status::ok);
    EXPECT_EQ(nameless.send_to("b", bytes_of("three")), Status::ok);
    EXPECT_EQ(receive(b, 9).text, "one");
    const Received empty = receive(b, 9);
    EXPECT_EQ(empty.status, Status::ok);
    EXPECT_EQ(empty.text, "");
    EXPECT_EQ(empty.datagram.from, Address("environment:a"));
    const Received cut = receive(b, 4);
    EXPECT_EQ(cut.text, "thre");
    EXPECT_TRUE(cut.datagram.truncated);
    EXPECT_EQ(cut.datagram.from.port, "");
    EXPECT_EQ(receive(b, 9, no_wait).status, Status::would_block) << "the rest of a datagram is gone";
    EXPECT_EQ(now(), Time());
  });
}

TEST(DatagramSocket, AFullQueueDropsAndCounts) {
  in_order([] {
    Network network;
    datagram_socket in(network, {.queue_max = 3}), out(network);
    EXPECT_EQ(in.bind("in"), Status::ok);
    for (const char* text : {"a", "b", "c", "d", "e"}) EXPECT_EQ(out.send_to("in", bytes_of(text)), Status::ok);
    EXPECT_EQ(in.dropped(), 2u);
    for (const char* text : {"a", "b", "c"}) EXPECT_EQ(receive(in, 9, no_wait).text, text);
    EXPECT_EQ(receive(in, 9, no_wait).status, Status::would_block);
  });
}

TEST(DatagramSocket, FailureToSendIsAReturnValue) {
  in_order([] {
    Network network;
    datagram_socket a(network, {.message_bytes_max = 8}), b(network);
    EXPECT_EQ(a.bind("name"), Status::ok);
    EXPECT_EQ(b.bind("name"), Status::address_in_use);
    EXPECT_EQ(a.send_to("name", bytes_of("123456789")), Status::message_too_long);
    EXPECT_EQ(a.send_to("name", bytes_of("12345678")), Status::ok);
    EXPECT_EQ(a.send_to("nobody:name", bytes_of("x")), Status::no_route) << "there is no such robot";
    EXPECT_EQ(a.send_to("other", bytes_of("x")), Status::ok) << "as UDP has it";
    EXPECT_EQ(network.statistics("environment", "environment").unreachable, 1u);
    a.close();
    EXPECT_EQ(b.bind("name"), Status::ok) << "a name is free again when its socket is closed";
  });
}

TEST(DatagramSocket, TimesOutAtTheDeadlineAndReceivesInTime) {
  in_every_order([] {
    Network network;
    datagram_socket in(network);
    EXPECT_EQ(in.bind("in"), Status::ok);
    EXPECT_EQ(receive(in, 9, 5ms).status, Status::timed_out);
    EXPECT_EQ(receive(in, 9, 0ms).status, Status::timed_out);
    EXPECT_EQ(now(), at(5ms));
    thread other([&] {
      sleep_for(2ms);
      EXPECT_EQ(datagram_socket(network).send_to("in", bytes_of("x")), Status::ok);
    });
    EXPECT_EQ(receive(in, 9, 3ms).text, "x");
    EXPECT_EQ(now(), at(7ms));
    other.join();
  });
}

TEST(DatagramSocket, SentAtTheInstantOfTheDeadlineNothingIsLost) {
  expect_both([] {
    Network network;
    datagram_socket in(network);
    EXPECT_EQ(in.bind("in"), Status::ok);
    Status status = Status::ok;
    thread other([&] { status = receive(in, 9, 5ms).status; });
    sleep_for(5ms);
    EXPECT_EQ(datagram_socket(network).send_to("in", bytes_of("x")), Status::ok);
    other.join();
    EXPECT_EQ(receive(in, 9, no_wait).status == Status::ok, status != Status::ok);
    return status == Status::ok;
  });
}

TEST(DatagramSocket, EachOfSeveralReceiversGetsOne) {
  in_every_order([] {
    Network network;
    datagram_socket in(network), out(network);
    EXPECT_EQ(in.bind("in"), Status::ok);
    std::array<int, 3> got{};
    std::vector<thread> threads;
    for (std::size_t i = 0; i < 3; ++i)
      threads.emplace_back([&, i] {
        while (receive(in, 9, 20ms).status == Status::ok) {
          ++got[i];
          sleep_for(5ms);
        }
      });
    for (int i = 0; i < 6; ++i) {
      sleep_for(1ms);
      EXPECT_EQ(out.send_to("in", bytes_of("x")), Status::ok);
    }
    for (thread& t : threads) t.join();
    EXPECT_EQ(got, (std::array<int, 3>{2, 2, 2}));
  });
}

TEST(DatagramSocket, CloseWakesWaitersAndPollers) {
  in_every_order([] {
    Network network;
    datagram_socket in(network);
    EXPECT_EQ(in.bind("in"), Status::ok);
    PollEntry entries[] = {{in, Events::readable}};
    EXPECT_EQ(poll(entries, no_wait).status(), Status::would_block);
    thread receiver([&] { EXPECT_EQ(receive(in, 9).status, Status::closed); });
    thread poller([&] {
      EXPECT_EQ(poll(entries).value(), 1u);
      EXPECT_EQ(entries[0].ready, Events::readable | Events::closed);
    });
    sleep_for(1ms);
    in.close();
    receiver.join();
    poller.join();
  });
}

TEST(DatagramSocket, DigestCoversSentMessages) {
  const auto digest = [](const char* to, const char* text) {
    return to_string(in_order([=] {
                       Network network;
                       EXPECT_EQ(datagram_socket(network).send_to(to, bytes_of(text)), Status::ok);
                     }).digest);
  };
  EXPECT_EQ(digest("a", "x"), digest("a", "x"));
  EXPECT_NE(digest("a", "x"), digest("a", "y"));
  EXPECT_NE(digest("a", "x"), digest("b", "x"));
}

TEST(DatagramSocketDeathTest, MisuseIsABug) {
  EXPECT_DEATH(simulate([] {
                 Network network;
                 datagram_socket s(network);
                 (void)s.bind("a");
                 (void)s.bind("b");
               }),
               "a datagram socket is bound a second time");
  EXPECT_DEATH(simulate([] {
                 Network network;
                 datagram_socket s(network);
                 s.close();
                 (void)s.send_to("a", {});
               }),
               "a datagram socket is used after its close");
  EXPECT_DEATH(simulate([] {
                 Network network;
                 (void)datagram_socket(network).bind("a:b");
               }),
               "a name to bind is empty or contains a colon");
  EXPECT_DEATH(simulate([] {
                 auto network = std::make_unique<Network>();
                 datagram_socket s(*network);
                 network.reset();
               }),
               "a network is destroyed before its sockets");
  EXPECT_DEATH(simulate([] {
                 Network network;
                 std::vector<datagram_socket> sockets;
                 for (;;) sockets.emplace_back(network);
               }),
               "a robot has more sockets than NetworkLimits::sockets_max");
  const auto with = [](const DatagramOptions& options) {
    return simulate([=] {
      Network network;
      datagram_socket(network, options);
    });
  };
  EXPECT_DEATH(with({.queue_max = 0}), "a datagram socket's queue holds at least one datagram and at most 65536");
  EXPECT_DEATH(with({.queue_max = datagrams_max + 1}), "at most 65536");
  EXPECT_DEATH(with({.message_bytes_max = datagram_bytes_max + 1}), "a datagram has at most 65507 bytes");
}

}  // namespace
}  // namespace waitpoint::io
