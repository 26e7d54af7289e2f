// SPDX-License-Identifier: BSD-3-Clause
// The task that an arrival from another robot serves: the first one in the default order, the chooser's choice in
// seeded ones, independent of all other messages.
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "fibers/io/datagram_socket.hpp"
#include "fibers/io/mailbox_sender.hpp"
#include "fibers/io/stream_listener.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// Three tasks of ada wait, the first since 1 ms, for bob's messages at 10, 20 and 30 ms: the order in which they are
// served. `wait` returns at an arrival.
using Wait = std::function<void()>;
std::string served(Fleet& fleet, const std::function<Wait(Network&)>& receive,
                   const std::function<std::function<void()>(Network&)>& send) {
  std::string order;
  fleet.spawn("ada", [&] {
    const Wait wait = receive(fleet.network);
    std::vector<thread> threads;
    for (const char name : {'a', 'b', 'c'})
      threads.emplace_back([&, name] {
        sleep_for((name - 'a' + 1) * 1ms);
        wait();
        order += name;
      });
    for (thread& t : threads) t.join();
  });
  fleet.spawn("bob", [&] {
    const auto tell = send(fleet.network);
    for (int i = 1; i <= 3; ++i) {
      this_thread::sleep_until(at(10ms * i));
      tell();
    }
    sleep_for(10ms);
  });
  fleet.run();
  return order;
}

Wait receive_datagrams(Network& network) {
  const auto socket = std::make_shared<datagram_socket>(network);
  EXPECT_EQ(socket->bind("door"), Status::ok);
  return [socket] {
    std::byte room[8];
    EXPECT_EQ(socket->receive(room).status(), Status::ok);
  };
}
std::function<void()> send_datagrams(Network& network) {
  const auto socket = std::make_shared<datagram_socket>(network);
  return [socket] { EXPECT_EQ(socket->send_to("ada:door", bytes_of("hello")), Status::ok); };
}

Wait receive_letters(Network& network) {
  const auto box = std::make_shared<mailbox<int>>(4);
  EXPECT_EQ(box->bind(network, "door"), Status::ok);
  return [box] { EXPECT_EQ(box->receive().status(), Status::ok); };
}
std::function<void()> send_letters(Network& network) {
  const auto sender = std::make_shared<mailbox_sender<int>>(network, "ada:door");
  return [sender] { EXPECT_EQ(sender->send(1), Status::ok); };
}

Wait accept_connections(Network& network) {
  const auto listener = std::make_shared<stream_listener>(network);
  EXPECT_EQ(listener->listen("door"), Status::ok);
  return [listener] { EXPECT_EQ(listener->accept().status(), Status::ok); };
}
std::function<void()> ask_for_connections(Network& network) {
  return [&network] { EXPECT_EQ(connect(network, "ada:door").status(), Status::ok); };
}

void expect_choice(const std::function<Wait(Network&)>& receive,
                   const std::function<std::function<void()>(Network&)>& send) {
  std::set<std::string> orders;
  for (std::uint64_t number = 0; number <= 60; ++number) {
    Fleet fleet({"ada", "bob"}, two_ms, order_number(number));
    const std::string order = served(fleet, receive, send);
    ASSERT_EQ(order.size(), 3u);
    if (number == 0) {
      EXPECT_EQ(order, "abc");
    }
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 6u);
}

TEST(Arrivals, ServeTheFirstWaiterAndAnyInSeededOrders) {
  expect_choice(receive_datagrams, send_datagrams);
  expect_choice(receive_letters, send_letters);
  expect_choice(accept_connections, ask_for_connections);
}

TEST(Arrivals, AreNotShiftedByRobotsThatTalkToOthers) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Fleet alone({"ada", "bob"}, two_ms, order_number(seed));
    const std::string order = served(alone, receive_datagrams, send_datagrams);
    Fleet among_others({"ada", "bob", "carl", "dora"}, two_ms, order_number(seed));
    among_others.spawn("carl", [&] {
      datagram_socket socket(among_others.network);
      for (int i = 0; i < 25; ++i) {
        EXPECT_EQ(socket.send_to("dora:door", bytes_of("hello")), Status::ok);
        sleep_for(1ms);
      }
    });
    among_others.spawn("dora", [&] {
      const Wait wait = receive_datagrams(among_others.network);
      for (int i = 0; i < 20; ++i) wait();
    });
    EXPECT_EQ(served(among_others, receive_datagrams, send_datagrams), order);
    EXPECT_EQ(among_others.digest("ada"), alone.digest("ada"));
  }
}

}  // namespace
}  // namespace waitpoint::io
