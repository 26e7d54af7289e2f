// SPDX-License-Identifier: BSD-3-Clause
// Mailboxes within a robot. By name and between robots: mailbox_sender_test.cpp.
#include "fibers/io/mailbox.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Mailbox, GivesLettersInOrderAndHoldsNoMoreThanItsCapacity) {
  in_every_order([] {
    mailbox<std::string> box(2);
    EXPECT_EQ(box.send("a"), Status::ok);
    EXPECT_EQ(box.try_send("b"), Status::ok);
    EXPECT_EQ(box.try_send("c"), Status::would_block);
    EXPECT_EQ(*box.receive(), "a");
    EXPECT_EQ(*box.try_receive(), "b");
    EXPECT_EQ(box.try_receive().status(), Status::would_block);
    EXPECT_EQ(now(), Time());
  });
}

TEST(Mailbox, ALetterThatDoesNotGoInStaysWithItsSender) {
  in_order([] {
    mailbox<std::unique_ptr<int>> box(1);
    auto one = std::make_unique<int>(1), two = std::make_unique<int>(2);
    EXPECT_EQ(box.send(std::move(one)), Status::ok);
    EXPECT_EQ(box.try_send(std::move(two)), Status::would_block);
    ASSERT_NE(two, nullptr);
    EXPECT_EQ(**box.receive(), 1);
  });
}

TEST(Mailbox, SendersAndReceiversWaitForEachOther) {
  in_every_order([] {
    mailbox<int> box(3);
    std::vector<int> got;
    thread receiver([&] {
      while (const Result<int> number = box.receive()) {
        got.push_back(number.value());
        sleep_for(1ms);
      }
    });
    for (int i = 0; i < 20; ++i) EXPECT_EQ(box.send(i), Status::ok);
    box.close();
    receiver.join();
    ASSERT_EQ(got.size(), 20u);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(got[static_cast<std::size_t>(i)], i);
  });
}

TEST(Mailbox, TimesOutAtTheDeadline) {
  in_every_order([] {
    mailbox<int> box(1);
    EXPECT_EQ(box.receive_for(5ms).status(), Status::timed_out);
    EXPECT_EQ(now(), at(5ms));
    EXPECT_EQ(box.receive(at(7ms)).status(), Status::timed_out);
    EXPECT_EQ(now(), at(7ms));
    EXPECT_EQ(box.receive_for(0ms).status(), Status::timed_out);
    EXPECT_EQ(box.send(1), Status::ok);
    EXPECT_EQ(box.send_for(2, 3ms), Status::timed_out);
    EXPECT_EQ(now(), at(10ms));
    thread other([&] {
      sleep_for(1ms);
      EXPECT_EQ(*box.receive(), 1);
    });
    EXPECT_EQ(box.send_for(3, 2ms), Status::ok);
    EXPECT_EQ(now(), at(11ms));
    other.join();
    EXPECT_EQ(*box.receive(), 3) << "what timed out is not in it";
  });
}

TEST(Mailbox, SentAtTheInstantOfTheDeadlineALetterIsNeverLost) {
  expect_both([] {
    mailbox<int> box(1);
    bool has = false;
    thread other([&] { has = static_cast<bool>(box.receive_for(5ms)); });
    sleep_for(5ms);
    EXPECT_EQ(box.send(1), Status::ok);
    other.join();
    EXPECT_EQ(static_cast<bool>(box.try_receive()), !has);
    return has;
  });
}

TEST(Mailbox, LettersAreConservedAmongManyInEveryOrder) {
  in_every_order([] {
    mailbox<int> box(3);
    int sent = 0, received = 0, sum = 0, most = 0, inside = 0;
    std::vector<thread> senders, receivers;
    for (std::uint64_t t = 0; t < 5; ++t)
      senders.emplace_back([&, t] {
        const RandomStream random(t, "", "letters");
        for (std::uint64_t i = 0; i < 20; ++i) {
          const auto span = std::chrono::microseconds(random.below(4, i));
          const int letter = static_cast<int>(100 * t + i);
          const Status status = i % 2 == 0 ? box.send(letter) : box.send_for(letter, span);
          if (status == Status::ok) {
            ++sent;
            sum += letter;
            most = std::max(most, ++inside);
          }
          sleep_for(span);
        }
      });
    for (std::uint64_t t = 0; t < 4; ++t)
      receivers.emplace_back([&, t] {
        const RandomStream random(t, "", "takers");
        for (std::uint64_t i = 0;; ++i) {
          const Result<int> letter =
              i % 3 == 0 ? box.receive() : box.receive_for(std::chrono::microseconds(random.below(4, i)));
          if (letter.status() == Status::end_of_file) break;
          if (!letter) continue;
          ++received;
          --inside;
          sum -= letter.value();
        }
      });
    for (thread& t : senders) t.join();
    box.close();
    for (thread& t : receivers) t.join();
    EXPECT_EQ(received, sent);
    EXPECT_GT(sent, 50);
    EXPECT_EQ(sum, 0);
    EXPECT_LE(most, 3 + 4) << "in the box, or with a receiver that has not counted it yet";
  });
}

TEST(Mailbox, ServesTheFirstWaiterFirst) {
  in_order([] {
    mailbox<int> box(4);
    std::string order;
    std::vector<thread> threads;
    for (const char name : {'a', 'b', 'c'})
      threads.emplace_back([&, name] {
        EXPECT_TRUE(box.receive());
        order += name;
      });
    sleep_for(1ms);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(box.send(i), Status::ok);
    for (thread& t : threads) t.join();
    EXPECT_EQ(order, "abc");
  });
}

TEST(Mailbox, CloseWakesAllWaiters) {
  in_every_order([] {
    mailbox<int> empty(1), full(1);
    EXPECT_EQ(full.send(1), Status::ok);
    thread receiver([&] { EXPECT_EQ(empty.receive().status(), Status::end_of_file); });
    thread sender([&] { EXPECT_EQ(full.send(2), Status::peer_closed); });
    sleep_for(1ms);
    empty.close();
    full.close();
    full.close();
    EXPECT_EQ(full.send(3), Status::peer_closed);
    EXPECT_EQ(*full.receive(), 1) << "what was in it can be received";
    EXPECT_EQ(full.receive().status(), Status::end_of_file);
    receiver.join();
    sender.join();
    EXPECT_EQ(now(), at(1ms));
  });
}

TEST(Mailbox, LettersAreInTheDigest) {
  const auto digest = [](int letter) {
    return to_string(in_order([=] { EXPECT_EQ(mailbox<int>(1).send(letter), Status::ok); }).digest);
  };
  EXPECT_EQ(digest(1), digest(1));
  EXPECT_NE(digest(1), digest(2));
}

TEST(Mailbox, IsFreshInTheNextRun) {
  mailbox<int> box(1);
  in_order([&] {
    EXPECT_EQ(box.send(1), Status::ok);
    box.close();
  });
  in_order([&] {
    EXPECT_EQ(box.try_receive().status(), Status::would_block);
    EXPECT_EQ(box.send(2), Status::ok);
  });
}

TEST(Mailbox, WaitingForNothingIsReportedAsADeadlock) {
  const Report report = simulate([] { (void)mailbox<int>(1, "orders").receive(); });
  EXPECT_FALSE(report.passed);
  EXPECT_NE(report.text.find("waits (receive) for mailbox #1 \"orders\""), std::string::npos) << report;
}

TEST(MailboxDeathTest, MisuseIsABug) {
  EXPECT_DEATH(mailbox<int>(0), "at least one letter");
  EXPECT_DEATH(mailbox<int>(letters_max + 1), "a mailbox holds at least one letter and at most 65536");
  EXPECT_DEATH((void)mailbox<int>(1).receive(), "outside a simulated task");
  EXPECT_DEATH(simulate([] {
                 auto box = std::make_unique<mailbox<int>>(1);
                 thread waiting([&] { (void)box->receive(); });
                 sleep_for(1ms);
                 box.reset();
                 waiting.join();
               }),
               "a mailbox is destroyed while a task waits at it");
  EXPECT_DEATH(
      {
        Simulation simulation;
        mailbox<int> box(1);
        simulation.spawn(simulation.add_robot("ada"), {}, [&] { (void)box.send(1); });
        simulation.spawn(simulation.add_robot("bob"), {}, [&] { (void)box.receive(); });
        simulation.run_before();
      },
      "used by a task of another robot");
}

}  // namespace
}  // namespace waitpoint::io
