// SPDX-License-Identifier: BSD-3-Clause
// Mailboxes by name, within a robot and over a medium.
#include "fibers/io/mailbox_sender.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "fibers/io/poll.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

struct Order {
  std::int32_t number = 0;
  double metres = 0;
  std::array<std::int16_t, 3> parts{};
  Bounded<Point, 4> way;
  static void fields(auto field) {
    field("number", &Order::number);
    field("metres", &Order::metres);
    field("parts", &Order::parts);
    field("way", &Order::way);
  }
};

TEST(MailboxSender, LettersTakeTheMediumsTimeAndKeepTheirOrder) {
  in_every_order({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 20ms, .loss = 1}, [](Fleet& fleet) {
    fleet.spawn("ada", [&] {
      mailbox<Order> box(4);
      EXPECT_EQ(box.bind(fleet.network, "orders"), Status::ok);
      for (int i = 0; i < 50; ++i) {
        Result<Order> order = box.receive();
        ASSERT_TRUE(order);
        EXPECT_EQ(order->number, i);
        EXPECT_EQ(order->metres, 0.5 * i);
      }
      EXPECT_EQ(box.receive_for(30ms).status(), Status::timed_out);
    });
    fleet.spawn("bob", [&] {
      mailbox_sender<Order> orders(fleet.network, "ada:orders");
      for (int i = 0; i < 50; ++i) {
        Order order;
        order.number = i;
        order.metres = 0.5 * i;
        EXPECT_EQ(orders.send(order), Status::ok);
      }
    });
  });
}

TEST(MailboxSender, HasAWindowOfLettersUnderWayOrNotYetReceived) {
  in_every_order({"ada", "bob"}, two_ms, [](Fleet& fleet) {
    fleet.spawn("ada", [&] {
      mailbox<int> box(1);
      EXPECT_EQ(box.bind(fleet.network, "in"), Status::ok);
      sleep_for(10ms);
      for (int i = 0; i < 4; ++i) EXPECT_EQ(*box.receive(), i);
      EXPECT_EQ(now(), at(14ms));
    });
    fleet.spawn("bob", [&] {
      mailbox_sender<int> to(fleet.network, "ada:in", 3);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(to.try_send(i), Status::ok);
      EXPECT_EQ(to.try_send(9), Status::would_block);
      EXPECT_EQ(to.send_for(9, 5ms), Status::timed_out);
      EXPECT_EQ(now(), at(5ms));
      PollEntry entries[] = {{to, Events::writable}};
      EXPECT_EQ(poll(entries, 2ms).status(), Status::timed_out);
      EXPECT_EQ(poll(entries).value(), 1u);
      EXPECT_EQ(now(), at(12ms)) << "ada's receipt has come back";
      EXPECT_EQ(to.send(3), Status::ok);
    });
  });
}

TEST(MailboxSender, WithinARobotLettersArriveAtOnce) {
  in_every_order([] {
    Network network;
    mailbox<int> box(1);
    EXPECT_EQ(box.bind(network, "in"), Status::ok);
    mailbox_sender<int> to(network, "in", 2);
    EXPECT_EQ(to.send(1), Status::ok);
    EXPECT_EQ(to.send(2), Status::ok) << "its window bounds it, not the mailbox's capacity";
    EXPECT_EQ(to.try_send(3), Status::would_block);
    EXPECT_EQ(box.try_send(4), Status::would_block);
    EXPECT_EQ(*box.receive(), 1);
    EXPECT_EQ(to.try_send(3), Status::ok);
    EXPECT_EQ(*box.receive(), 2);
    EXPECT_EQ(*box.receive(), 3);
    EXPECT_EQ(box.try_send(4), Status::ok);
    EXPECT_EQ(now(), Time());
  });
}

TEST(MailboxSender, LearnsWhatBecameOfTheMailbox) {
  in_every_order({"ada", "bob"}, two_ms, [](Fleet& fleet) {
    fleet.spawn("ada", [&] {
      std::optional<mailbox<int>> box(std::in_place, 1);
      mailbox<int> second(1);
      EXPECT_EQ(box->bind(fleet.network, "in"), Status::ok);
      EXPECT_EQ(second.bind(fleet.network, "in"), Status::address_in_use);
      sleep_for(10ms);
      box.reset();
      EXPECT_EQ(second.bind(fleet.network, "in"), Status::ok) << "a name is free again when its mailbox is gone";
      second.close();
    });
    fleet.spawn("bob", [&] {
      mailbox_sender<int> nobody(fleet.network, "ada:other", 1), full(fleet.network, "ada:in", 1),
          nowhere(fleet.network, "eve:in", 1);
      EXPECT_EQ(nowhere.send(1), Status::no_route);
      EXPECT_EQ(nobody.send(1), Status::ok);
      EXPECT_EQ(nobody.send(2), Status::refused);
      EXPECT_EQ(now(), at(4ms));
      EXPECT_EQ(full.send(1), Status::ok);
      EXPECT_EQ(full.send(2), Status::peer_closed) << "while it waits";
      EXPECT_EQ(now(), at(12ms));
    });
  });
}

TEST(MailboxSender, ALetterHasTheSizeOfItsFields) {
  Order order;
  EXPECT_EQ(wire_bytes(order), 4u + 8 + 6 + 4);
  order.way.push_back({1, 2});
  EXPECT_EQ(wire_bytes(order), 4u + 8 + 6 + 4 + 16);
  EXPECT_EQ(wire_bytes(std::uint8_t{1}), 1u);
  Fleet fleet({"ada", "bob"}, {.latency_least = 1ms, .latency_most = 1ms, .bandwidth_bit_s = 8'000});
  fleet.spawn("ada", [&] {
    mailbox<Order> box(4);
    EXPECT_EQ(box.bind(fleet.network, "in"), Status::ok);
    EXPECT_TRUE(box.receive());
    EXPECT_EQ(now(), at(38ms + 1ms));
  });
  fleet.spawn("bob", [&] { EXPECT_EQ(mailbox_sender<Order>(fleet.network, "ada:in").send(order), Status::ok); });
  fleet.run();
}

TEST(MailboxSenderDeathTest, MisuseIsABug) {
  EXPECT_DEATH(simulate([] {
                 Network network;
                 mailbox<int> box(1);
                 (void)box.bind(network, "in");
                 (void)mailbox_sender<double>(network, "in").send(1);
               }),
               "a letter is sent to a mailbox of another type");
  EXPECT_DEATH(simulate([] {
                 Network network;
                 mailbox<int> box(1);
                 (void)box.bind(network, "a");
                 (void)box.bind(network, "b");
               }),
               "a mailbox is bound a second time");
  for (const std::size_t window : {std::size_t{0}, letters_max + 1})
    EXPECT_DEATH(simulate([window] {
                   Network network;
                   mailbox_sender<int>(network, "in", window);
                 }),
                 "a mailbox sender's window holds at least one letter and at most 65536");
}

}  // namespace
}  // namespace waitpoint::io
