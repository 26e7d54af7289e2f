// SPDX-License-Identifier: BSD-3-Clause
// Mailboxes and clients: letters arrive in order, a full mailbox rejects letters, and no task waits for a client that
// does not read.
#include <gtest/gtest.h>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Act = Running<Number, Number>;

struct MailboxRobot : TestRobot {
  MailboxRobot() {
    module.add_control<Number, Number>("Echo", [](const Number& in, Number& out) { return out = in, ok; });
  }
};

TEST(Mailbox, KeepsLettersInOrderUpToItsBound) {
  const waitpoint::Report report = simulate([] {
    Mailbox mailbox("owner");
    Letter letter;
    EXPECT_FALSE(mailbox.take(letter));
    for (std::uint32_t round = 0; round < 3; ++round) {
      for (std::uint32_t i = 0; i < Mailbox::letters_max; ++i) {
        letter.send_id = i;
        EXPECT_TRUE(mailbox.post(letter));
      }
      EXPECT_FALSE(mailbox.post(letter));
      for (std::uint32_t i = 0; i < Mailbox::letters_max; ++i) {
        EXPECT_TRUE(mailbox.event().try_acquire());
        EXPECT_TRUE(mailbox.take(letter));
        EXPECT_EQ(letter.send_id, i);
      }
      EXPECT_FALSE(mailbox.event().try_acquire());
      EXPECT_FALSE(mailbox.take(letter));
    }
  });
  EXPECT_TRUE(report.passed) << report;
}

TEST(Client, IsToldWhenTheModulesMailboxIsFull) {
  MailboxRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  task.set_permanent([] { compute(8ms); });  // blocks the control task for so long
  robot.run([&] {
    sleep_for(12ms);
    std::size_t sent = 0;
    while (robot.client.send("m", "Echo", Number{static_cast<std::int32_t>(sent)})) ++sent;
    EXPECT_GE(sent, Mailbox::letters_max);
    EXPECT_LE(sent, Mailbox::letters_max + 1);  // the control task may have taken one
    for (std::size_t i = 0; i < sent; ++i)
      EXPECT_EQ(robot.next().output.as<Number>().value, static_cast<std::int32_t>(i));
    EXPECT_FALSE(robot.client.receive(1s));
    EXPECT_EQ(robot.client.call("m", "Echo", Number{5}).output.as<Number>().value, 5);
  });
}

TEST(Client, NotReadingLosesRepliesAndBlocksNoOther) {
  MailboxRobot robot;
  robot.run([&] {
    for (int i = 0; i < 100; ++i) {
      EXPECT_TRUE(robot.client.send("m", "Echo", Number{i}));
      sleep_for(1ms);
    }
    EXPECT_EQ(robot.other.call("m", "Echo", Number{5}).report, ok);
    for (int i = 0; i < static_cast<int>(Mailbox::letters_max); ++i)
      EXPECT_EQ(robot.next(Duration()).output.as<Number>().value, i);
    EXPECT_FALSE(robot.client.receive(Duration()));
  });
}

TEST(Client, WaitsForRepliesAsLongAsItIsAskedTo) {
  MailboxRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  robot.module.add_activity<Number, Number>("Go", task, {.exec = [](Act&) { return State::ether; }});
  robot.run([&] {
    EXPECT_FALSE(robot.client.receive(Duration()));
    EXPECT_EQ(now(), Time());
    EXPECT_FALSE(robot.client.receive(3ms));
    EXPECT_EQ(now(), at(3ms));
    robot.begin("Go");
    EXPECT_FALSE(robot.client.receive(7ms - 1ns));
    EXPECT_TRUE(robot.client.receive(Duration::max()));
    EXPECT_EQ(now(), at(10ms));
  });
}

TEST(Client, ACallWaitsForItsOwnFinalReply) {
  MailboxRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  robot.module.add_activity<Number, Number>("Go", task, {.exec = [](Act& act) {
                                              act.output = act.input;
                                              return State::ether;
                                            }});
  robot.run([&] {
    EXPECT_TRUE(robot.client.send("m", "Echo", Number{1}));
    const Reply reply = robot.client.call("m", "Go", Number{9});
    EXPECT_TRUE(reply.final);
    EXPECT_EQ(reply.output.as<Number>().value, 9);
    EXPECT_EQ(now(), at(10ms));
    EXPECT_FALSE(robot.client.receive(1s));  // the echo's reply was dropped
  });
}

TEST(Client, ACallHasItsReplyThoughTheMailboxIsFullOfOthers) {
  MailboxRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  robot.module.add_activity<Number, Number>("Go", task, {.exec = [](Act&) { return State::ether; }});
  robot.run([&] {
    for (std::size_t i = 0; i < Mailbox::letters_max; ++i) {
      EXPECT_TRUE(robot.client.send("m", "Echo", Number{1}));
      sleep_for(1ms);
    }
    EXPECT_EQ(robot.client.call("m", "Echo", Number{5}).output.as<Number>().value, 5);
    for (std::size_t i = 0; i < Mailbox::letters_max; ++i) {
      EXPECT_TRUE(robot.client.send("m", "Echo", Number{1}));
      sleep_for(1ms);
    }
    EXPECT_TRUE(robot.client.call("m", "Go", Number()).final);
  });
}

TEST(Mailbox, KeepsRoomForRepliesToOneRequestOnly) {
  const waitpoint::Report report = simulate([] {
    Mailbox mailbox("owner");
    Letter letter;
    letter.kind = LetterKind::final_reply;
    letter.send_id = 7;
    mailbox.keep_room_for(8);
    for (std::size_t i = 0; i < Mailbox::letters_max; ++i) EXPECT_TRUE(mailbox.post(letter));
    EXPECT_FALSE(mailbox.post(letter));
    letter.send_id = 8;
    EXPECT_TRUE(mailbox.post(letter));
    letter.kind = LetterKind::request;  // of another sender, with its own numbers
    EXPECT_FALSE(mailbox.post(letter));
  });
  EXPECT_TRUE(report.passed) << report;
}

TEST(Letters, EveryPartOfThemIsPartOfTheDigest) {
  const auto digest = [](const std::function<void(Letter&)>& change) {
    const waitpoint::Report report = simulate([&] {
      Mailbox mailbox("owner");
      Letter letter;
      letter.payload = Payload(Number{5});
      change(letter);
      mailbox.post(letter);
    });
    return to_string(report.digest);
  };
  const std::string base = digest([](Letter&) {});
  EXPECT_EQ(digest([](Letter&) {}), base);
  EXPECT_NE(digest([](Letter& l) { l.kind = LetterKind::final_reply; }), base);
  EXPECT_NE(digest([](Letter& l) { l.request = 1; }), base);
  EXPECT_NE(digest([](Letter& l) { l.send_id = 1; }), base);
  EXPECT_NE(digest([](Letter& l) { l.activity = 1; }), base);
  EXPECT_NE(digest([](Letter& l) { l.report = 1; }), base);
  EXPECT_NE(digest([](Letter& l) { l.payload = Payload(Number{6}); }), base);
}

TEST(PayloadDeathTest, IsOfTheTypeThatWasPutIn) {
  const Payload payload(Number{5});
  EXPECT_TRUE(payload.holds<Number>());
  EXPECT_FALSE(payload.holds<AbortInput>());
  EXPECT_TRUE(Payload().holds<Nothing>());
  EXPECT_DEATH(payload.as<AbortInput>(), "taken for another type");
}

}  // namespace
}  // namespace waitpoint::genom
