// SPDX-License-Identifier: BSD-3-Clause
// What csLib does not use of gcomLib: sends that wait, lists of letters, and late replies.
#include "fibers/laas/include/gcomLib.h"

#include <array>

#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

constexpr int mailbox_size = 1024;

LETTER_ID letter(int value = 0) {
  LETTER_ID made = nullptr;
  EXPECT_EQ(gcomLetterAlloc(sizeof value, &made), OK);
  EXPECT_EQ(gcomLetterWrite(made, 1, reinterpret_cast<char*>(&value), sizeof value, nullptr), OK);
  return made;
}

int value_of(LETTER_ID read) {
  int value = -1;
  EXPECT_EQ(gcomLetterRead(read, reinterpret_cast<char*>(&value), sizeof value, nullptr), 4);
  return value;
}

// Replies to each letter `delay` ticks later: an intermediate reply, and after as long the final one.
void answer(int delay) {
  ASSERT_EQ(gcomInit("answering", mailbox_size, 0), OK);
  const LETTER_ID received = letter();
  for (;;) {
    MBOX_ID from = 0;
    int send_id = -1;
    if (gcomLetterRcv(received, &from, &send_id, 0) != TRUE) return;
    taskDelay(delay);
    EXPECT_EQ(gcomLetterReply(from, send_id, INTERMED_REPLY, letter(value_of(received) + 1)), OK);
    taskDelay(delay);
    EXPECT_EQ(gcomLetterReply(from, send_id, FINAL_REPLY, letter(value_of(received) + 2)), OK);
  }
}

void with_answers(int delay, const std::function<void(MBOX_ID)>& body) {
  with_clock([&] {
    thread({.name = "answering", .service = true}, [delay] { answer(delay); }).detach();
    taskDelay(1);
    MBOX_ID to = 0;
    ASSERT_EQ(gcomMboxFind("answering", &to), OK);
    ASSERT_EQ(gcomInit("asking", 0, mailbox_size), OK);
    body(to);
  });
}

TEST(GcomLib, ASendWaitsForTheReplyThatItNames) {
  with_answers(5, [](MBOX_ID to) {
    const LETTER_ID first = letter(), last = letter();
    int id = -1;
    EXPECT_EQ(gcomLetterSend(to, letter(10), first, last, BLOCK_ON_INTERMED_REPLY, &id, 0, 0), WAITING_FINAL_REPLY);
    EXPECT_EQ(value_of(first), 11);
    EXPECT_EQ(tickGet(), 6u);
    EXPECT_EQ(gcomReplyWait(id, FINAL_REPLY), FINAL_REPLY_OK);
    EXPECT_EQ(value_of(last), 12);
    EXPECT_EQ(gcomReplyStatus(id), FREE);
    EXPECT_EQ(gcomLetterSend(to, letter(20), first, last, BLOCK_ON_FINAL_REPLY, nullptr, 0, 0), FINAL_REPLY_OK);
    EXPECT_EQ(value_of(last), 22);
    EXPECT_EQ(gcomLetterSend(to, letter(30), first, last, BLOCK_ON_FINAL_REPLY, nullptr, 0, 8), FINAL_REPLY_TIMEOUT);
  });
}

TEST(GcomLib, LettersThatWaitAreListed) {
  with_answers(5, [](MBOX_ID to) {
    const LETTER_ID first = letter(), last = letter();
    int id = -1;
    EXPECT_EQ(gcomLetterSend(to, letter(1), first, last, NO_BLOCK, &id, 0, 0), WAITING_INTERMED_REPLY);
    EXPECT_EQ(gcomLetterSend(to, letter(2), nullptr, last, NO_BLOCK, &id, 0, 3), WAITING_FINAL_REPLY);
    std::array<int, 4> ids{};
    EXPECT_EQ(gcomSendIdList(ids.data(), 4), 2);
    EXPECT_EQ(ids[1], id);
    LETTER_ID intermediate = nullptr, final = nullptr;
    gcomReplyLetterBySendId(0, &intermediate, &final);
    EXPECT_EQ(intermediate, first);
    EXPECT_EQ(final, last);
    taskDelay(7);
    std::array<char, MAX_SEND> states{};
    states[0] = states[1] = 1;
    gcomSelect(states.data());
    EXPECT_EQ(states[0], WAITING_FINAL_REPLY);
    EXPECT_EQ(states[1], FINAL_REPLY_TIMEOUT);
    EXPECT_EQ(gcomSendIdFree(id), OK);
    EXPECT_EQ(gcomSendIdList(ids.data(), 4), 1);
  });
}

// The number is used again, so the late reply is taken for the new letter's: pocolibs' documentation warns of it.
TEST(GcomLib, ALateReplyIsTakenForTheNextLetterOfItsNumber) {
  with_answers(5, [](MBOX_ID to) {
    const LETTER_ID last = letter();
    int id = -1;
    gcomLetterSend(to, letter(1), nullptr, last, NO_BLOCK, &id, 0, 3);
    EXPECT_EQ(gcomReplyWait(id, FINAL_REPLY), FINAL_REPLY_TIMEOUT);
    gcomSendIdFree(id);
    EXPECT_EQ(gcomLetterSend(to, letter(100), nullptr, last, BLOCK_ON_FINAL_REPLY, nullptr, 0, 0), FINAL_REPLY_OK);
    EXPECT_EQ(value_of(last), 3);
  });
}

TEST(GcomLib, MistakesAreErrors) {
  with_answers(1, [](MBOX_ID to) {
    const LETTER_ID last = letter(), discarded = letter();
    int id = 0;
    EXPECT_EQ(gcomLetterSend(to, letter(1), nullptr, last, BLOCK_ON_INTERMED_REPLY, &id, 0, 0), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_INVALID_BLOCK_MODE");
    EXPECT_EQ(gcomLetterDiscard(discarded), OK);
    EXPECT_EQ(gcomLetterType(discarded), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_NOT_A_LETTER");
    EXPECT_EQ(gcomLetterSend(to, last, nullptr, discarded, NO_BLOCK, &id, 0, 0), ERROR);
    EXPECT_EQ(gcomReplyStatus(MAX_SEND), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_ERR_SEND_ID");
    EXPECT_EQ(gcomReplyWait(0, 3), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_REPLY_LETTER_TYPE");
    EXPECT_EQ(gcomLetterList(nullptr, 0), 0);
    std::array<char, 32> name{};
    EXPECT_EQ(gcomMboxName(to, name.data()), OK);
    EXPECT_STREQ(name.data(), "answering");
    for (int i = 0; i < MAX_SEND; ++i)
      gcomLetterSend(to, letter(i), nullptr, last, NO_BLOCK, &id, 0, 0);  // some find the mailbox full
    EXPECT_EQ(error_name(), "S_mboxLib_MBOX_FULL");
    EXPECT_EQ(gcomEnd(), OK);
    EXPECT_EQ(gcomMboxStatus(REPLY_MBOX), ERROR);
    EXPECT_EQ(error_name(), "S_mboxLib_MBOX_CLOSED");
  });
}

}  // namespace
}  // namespace waitpoint
