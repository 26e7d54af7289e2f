// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/include/mboxLib.h"

#include <array>
#include <cerrno>

#include "fibers/laas/include/h2devLib.h"
#include "fibers/laas/include/h2evnLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

MBOX_ID create(const char* name, int size) {
  MBOX_ID mailbox = 0;
  EXPECT_EQ(mboxInit(nullptr), OK) << error_name();
  EXPECT_EQ(mboxCreate(name, size, &mailbox), OK) << error_name();
  return mailbox;
}

STATUS send(MBOX_ID to, const char* text, MBOX_ID from = 0) {
  return mboxSend(to, from, const_cast<char*>(text), static_cast<int>(std::string(text).size()) + 1);
}

// The next message's text, or its result where there is none.
std::string receive(MBOX_ID mailbox, int timeout = 0, int room = 64) {
  std::array<char, 64> text{};
  MBOX_ID from = 0;
  const int bytes = mboxRcv(mailbox, &from, text.data(), room, timeout);
  return bytes > 0 ? text.data() : std::to_string(bytes);
}

int ask(MBOX_ID mailbox, int code) {
  int value = -2;
  EXPECT_EQ(mboxIoctl(mailbox, code, &value), OK);
  return value;
}

TEST(MboxLib, MessagesComeInTheirOrderWithTheirSenders) {
  with_clock([] {
    const MBOX_ID to = create("to", 100), from = create("from", 100);
    send(to, "one", from);
    send(to, "two", 7);
    std::array<char, 8> text{};
    MBOX_ID sender = 0;
    EXPECT_EQ(mboxRcv(to, &sender, text.data(), 8, 0), 4);
    EXPECT_STREQ(text.data(), "one");
    EXPECT_EQ(sender, from);
    EXPECT_EQ(mboxRcv(to, &sender, text.data(), 8, 0), 4);
    EXPECT_EQ(sender, 7);
  });
}

// A message of 7 bytes takes 16 of a ring of 112, which is never full: 6 of them.
TEST(MboxLib, AMailboxHasTheRoomOfPocolibsRing) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    EXPECT_EQ(ask(mailbox, FIO_SIZE), 100);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(send(mailbox, "abcdef"), OK);
    EXPECT_EQ(send(mailbox, "abcdef"), ERROR);
    EXPECT_EQ(error_name(), "S_mboxLib_MBOX_FULL");
    EXPECT_EQ(ask(mailbox, FIO_NMSGS), 6);
    EXPECT_EQ(ask(mailbox, FIO_NBYTES), 96);
    receive(mailbox);
    EXPECT_EQ(send(mailbox, "abcdef"), OK);
    // It grows, and does not shrink.
    EXPECT_EQ(mboxResize(mailbox, 200), OK);
    EXPECT_EQ(send(mailbox, "abcdef"), OK);
    EXPECT_EQ(mboxResize(mailbox, 150), ERROR);
    EXPECT_EQ(error_name(), "S_h2rngLib_ILLEGAL_NBYTES");
    EXPECT_EQ(mboxIoctl(mailbox, FIO_FLUSH, nullptr), OK);
    EXPECT_EQ(ask(mailbox, FIO_NBYTES), 0);
    std::array<char, H2_DEV_MAX_NAME> name{};
    EXPECT_EQ(mboxIoctl(mailbox, FIO_GETNAME, name.data()), OK);
    EXPECT_STREQ(name.data(), "letters");
  });
}

TEST(MboxLib, AReceiverWaitsForAMessageOrTheTimeOut) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    EXPECT_EQ(receive(mailbox, 3), "0");  // at the 4th tick
    EXPECT_EQ(error_name(), "S_h2semLib_TIMEOUT");
    EXPECT_EQ(tickGet(), 4u);
    thread sender = start_task("sender", [mailbox] {
      taskDelay(5);
      send(mailbox, "late");
    });
    EXPECT_EQ(receive(mailbox, WAIT_FOREVER), "late");
    EXPECT_EQ(tickGet(), 9u);
    sender.join();
    EXPECT_EQ(receive(mailbox, -2), "-1");
    EXPECT_EQ(errnoGet(), EINVAL);
  });
}

TEST(MboxLib, AMessageThatDoesNotFitEmptiesTheMailbox) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    send(mailbox, "abcdef");
    send(mailbox, "b");
    EXPECT_EQ(receive(mailbox, 0, 3), "-1");
    EXPECT_EQ(error_name(), "S_h2rngLib_SMALL_BUF");
    EXPECT_EQ(ask(mailbox, FIO_NMSGS), 0);
  });
}

TEST(MboxLib, TheFirstMessageIsSeenAndSkipped) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    std::array<char, 4> text{};
    MBOX_ID from = 0;
    int bytes = 0;
    EXPECT_EQ(mboxSpy(mailbox, &from, &bytes, text.data(), 3), 0);
    send(mailbox, "abcdef", 5);
    send(mailbox, "next");
    EXPECT_EQ(mboxSpy(mailbox, &from, &bytes, text.data(), 3), 3);
    EXPECT_STREQ(text.data(), "abc");
    EXPECT_EQ(bytes, 7);
    EXPECT_EQ(from, 5);
    EXPECT_EQ(mboxSkip(mailbox), OK);
    EXPECT_EQ(receive(mailbox), "next");
    EXPECT_EQ(mboxSkip(mailbox), OK);
  });
}

TEST(MboxLib, ATaskWaitsForOneMailboxOrForAllOfItsOwn) {
  with_clock([] {
    const MBOX_ID first = create("first", 100), second = create("second", 100);
    MBOX_ID others = 0;
    thread other = start_task("other", [&] {
      others = create("others", 100);
      send(others, "not the main task's");
      taskDelay(2);
      send(second, "a");
      taskDelay(2);
      send(first, "b");
    });
    EXPECT_EQ(mboxPause(ALL_MBOX, 0), TRUE);
    EXPECT_EQ(tickGet(), 2u);
    EXPECT_EQ(ask(second, FIO_NMSGS), 1);
    EXPECT_EQ(mboxPause(first, 0), TRUE);
    EXPECT_EQ(tickGet(), 4u);
    receive(first);
    receive(second);
    EXPECT_EQ(mboxPause(first, 2), FALSE);
    EXPECT_EQ(mboxPause(ALL_MBOX, 2), FALSE);
    EXPECT_EQ(error_name(), "S_h2semLib_TIMEOUT");
    other.join();
  });
}

TEST(MboxLib, AMessageIsAnEventOfTheOwner) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    h2evnClear();
    thread sender = start_task("sender", [mailbox] {
      send(mailbox, "a");
      send(mailbox, "b");
    });
    EXPECT_EQ(h2evnSusp(100), TRUE);
    EXPECT_EQ(tickGet(), 0u);
    sender.join();
    h2evnClear();
    EXPECT_EQ(h2evnSusp(2), FALSE);
  });
}

TEST(MboxLib, AClosedMailboxIsAnErrorAlsoForWaitingTasks) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    thread waiting = start_task("waiting", [mailbox] {
      EXPECT_EQ(receive(mailbox), "-1");
      EXPECT_EQ(error_name(), "S_mboxLib_MBOX_CLOSED");
    });
    taskDelay(1);
    EXPECT_EQ(mboxDelete(mailbox), OK);
    waiting.join();
    EXPECT_EQ(send(mailbox, "a"), ERROR);
    EXPECT_EQ(error_name(), "S_mboxLib_MBOX_CLOSED");
    EXPECT_EQ(mboxDelete(mailbox), ERROR);
    int value = 0;
    EXPECT_EQ(mboxIoctl(mailbox, FIO_NMSGS, &value), ERROR);
    // The next of that name has another id.
    EXPECT_NE(create("letters", 100), mailbox);
    EXPECT_EQ(mboxPause(mailbox, 0), ERROR);
  });
}

TEST(MboxLib, MistakesAreErrors) {
  with_clock([] {
    const MBOX_ID mailbox = create("letters", 100);
    MBOX_ID other = 0;
    EXPECT_EQ(mboxCreate("letters", 100, &other), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_DUPLICATE_DEVICE_NAME");
    EXPECT_EQ(mboxCreate("none", 0, &other), ERROR);
    EXPECT_EQ(error_name(), "S_h2rngLib_ILLEGAL_NBYTES");
    EXPECT_EQ(mboxFind("nowhere", &other), ERROR);
    EXPECT_EQ(mboxSend(mailbox, 0, nullptr, 0), ERROR);
    EXPECT_EQ(mboxIoctl(mailbox, 99, &other), ERROR);
    EXPECT_EQ(error_name(), "S_mboxLib_BAD_IOCTL_CODE");
    thread stranger = start_task("stranger", [] {
      EXPECT_EQ(mboxEnd(0), ERROR);
      EXPECT_EQ(error_name(), "S_mboxLib_NOT_OWNER");
    });
    stranger.join();
  });
}

TEST(MboxLib, ATaskTakesItsMailboxesWithIt) {
  with_clock([] {
    MBOX_ID mine = create("mine", 100), found = 0;
    EXPECT_EQ(mboxFind("mine", &found), OK);
    EXPECT_EQ(found, mine);
    EXPECT_EQ(h2devFind(taskName(0), H2_DEV_TYPE_TASK), 1);
    EXPECT_EQ(mboxEnd(0), OK);
    EXPECT_EQ(mboxFind("mine", &found), ERROR);
    EXPECT_EQ(h2devFind(taskName(0), H2_DEV_TYPE_TASK), ERROR);
  });
}

TEST(MboxLib, TwoTasksOfOneNameCannotBothHaveMailboxes) {
  with_clock([] {
    create("mine", 100);
    const std::string name = taskName(0);
    thread twin = start_task(name.c_str(), [] {
      EXPECT_EQ(mboxInit(nullptr), ERROR);
      EXPECT_EQ(error_name(), "S_mboxLib_NAME_IN_USE");
    });
    twin.join();
    EXPECT_EQ(mboxInit(nullptr), OK);
  });
}

TEST(MboxLib, ATableNamesTheMailboxes) {
  testing::internal::CaptureStderr();
  in_order([] {
    send(create("letters", 100), "abcdef");
    mboxShow();
  });
  const std::string table = testing::internal::GetCapturedStderr();
  EXPECT_NE(table.find("letters                            2      100    1       16\n"), table.npos) << table;
}

}  // namespace
}  // namespace waitpoint
