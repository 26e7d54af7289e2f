// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/include/csLib.h"

#include <array>
#include <cstdint>
#include <vector>

#include "fibers/laas/include/h2evnLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

enum Type : std::uint8_t { add_one, slowly, refuse, keep, unknown };
constexpr int mailbox_size = 4096, most = 64;

int input_of(SERV_ID server, int id) {
  int value = 0;
  EXPECT_EQ(csServRqstParamsGet(server, id, reinterpret_cast<char*>(&value), sizeof value, nullptr), OK);
  return value;
}

STATUS reply(SERV_ID server, int id, int type, int value, int report = OK) {
  return csServReplySend(server, id, type, report, reinterpret_cast<char*>(&value), sizeof value, nullptr);
}

void do_add_one(SERV_ID server, int id) { EXPECT_EQ(reply(server, id, FINAL_REPLY, input_of(server, id) + 1), OK); }

// The intermediate reply after 5 ticks, the final one after 5 more.
void do_slowly(SERV_ID server, int id) {
  const int value = input_of(server, id);
  taskDelay(5);
  EXPECT_EQ(reply(server, id, INTERMED_REPLY, value), OK);
  taskDelay(5);
  EXPECT_EQ(reply(server, id, FINAL_REPLY, -value), OK);
}

void do_refuse(SERV_ID server, int id) { reply(server, id, FINAL_REPLY, 0, H2_ENCODE_ERR(800, 5)); }

void do_keep(SERV_ID, int) {}

// A server that executes requests until the run ends, and a client of it in the main task.
void with_server(const std::function<void(CLIENT_ID)>& body) {
  with_clock([&body] {
    const SEM_ID ready = semBCreate(0, SEM_EMPTY);
    thread({.name = "server", .service = true}, [ready] {
      SERV_ID server = nullptr;
      ASSERT_EQ(csMboxInit("server", mailbox_size, 0), OK);
      ASSERT_EQ(csServInit(most, most, &server), OK);
      ASSERT_EQ(csServFuncInstall(server, add_one, do_add_one), OK);
      ASSERT_EQ(csServFuncInstall(server, slowly, do_slowly), OK);
      ASSERT_EQ(csServFuncInstall(server, refuse, do_refuse), OK);
      ASSERT_EQ(csServFuncInstall(server, keep, do_keep), OK);
      semGive(ready);
      for (;;) csServRqstExec(server);
    }).detach();
    semTake(ready, WAIT_FOREVER);
    CLIENT_ID client = nullptr;
    ASSERT_EQ(csMboxInit("client", 0, mailbox_size), OK);
    ASSERT_EQ(csClientInit("server", most, most, most, &client), OK);
    body(client);
    EXPECT_EQ(csClientEnd(client), OK);
    EXPECT_EQ(csMboxEnd(), OK);
  });
}

int send(CLIENT_ID client, Type type, int value, bool intermediate = false, int first = 0, int last = 0) {
  int id = -1;
  EXPECT_EQ(csClientRqstSend(client, type, reinterpret_cast<char*>(&value), sizeof value, nullptr,
                             intermediate ? TRUE : FALSE, first, last, &id),
            OK);
  return id;
}

struct Received {
  int state;
  int intermediate = 0;
  int final = 0;
};

Received receive(CLIENT_ID client, int id, int block) {
  Received got{};
  got.state = csClientReplyRcv(client, id, block, reinterpret_cast<char*>(&got.intermediate), sizeof(int), nullptr,
                               reinterpret_cast<char*>(&got.final), sizeof(int), nullptr);
  return got;
}

TEST(CsLib, ARequestGetsItsFinalReply) {
  with_server([](CLIENT_ID client) {
    const Received got = receive(client, send(client, add_one, 41), BLOCK_ON_FINAL_REPLY);
    EXPECT_EQ(got.state, FINAL_REPLY_OK);
    EXPECT_EQ(got.final, 42);
  });
}

TEST(CsLib, TheIntermediateReplyComesFirst) {
  with_server([](CLIENT_ID client) {
    const int id = send(client, slowly, 7, true);
    EXPECT_EQ(receive(client, id, NO_BLOCK).state, WAITING_INTERMED_REPLY);
    const Received first = receive(client, id, BLOCK_ON_INTERMED_REPLY);
    EXPECT_EQ(first.state, WAITING_FINAL_REPLY);
    EXPECT_EQ(first.intermediate, 7);
    EXPECT_EQ(tickGet(), 5u);
    EXPECT_EQ(receive(client, id, NO_BLOCK).state, WAITING_FINAL_REPLY);
    const Received last = receive(client, id, BLOCK_ON_FINAL_REPLY);
    EXPECT_EQ(last.state, FINAL_REPLY_OK);
    EXPECT_EQ(last.final, -7);
    EXPECT_EQ(tickGet(), 10u);
    // Its number is free.
    EXPECT_EQ(receive(client, id, NO_BLOCK).state, ERROR);
    EXPECT_EQ(error_name(), "S_csLib_BAD_RQST_ID");
  });
}

// pocolibs' time-outs end at the n+1st tick since the request was sent.
TEST(CsLib, BothRepliesHaveTimeOuts) {
  with_server([](CLIENT_ID client) {
    int id = send(client, slowly, 1, true, 3, 0);
    EXPECT_EQ(receive(client, id, BLOCK_ON_INTERMED_REPLY).state, INTERMED_REPLY_TIMEOUT);
    EXPECT_EQ(tickGet(), 4u);
    EXPECT_EQ(receive(client, id, BLOCK_ON_FINAL_REPLY).state, INTERMED_REPLY_TIMEOUT);
    taskDelay(20);
    EXPECT_EQ(csMboxStatus(REPLY_MBOX), REPLY_MBOX);  // the late replies, which a look discards
    EXPECT_EQ(receive(client, id, NO_BLOCK).state, INTERMED_REPLY_TIMEOUT);
    EXPECT_EQ(csMboxStatus(REPLY_MBOX), 0);
    EXPECT_EQ(csClientRqstIdFree(client, id), OK);
    id = send(client, slowly, 2, true, 0, 7);
    EXPECT_EQ(tickGet(), 24u);
    EXPECT_EQ(receive(client, id, BLOCK_ON_INTERMED_REPLY).state, WAITING_FINAL_REPLY);
    EXPECT_EQ(receive(client, id, BLOCK_ON_FINAL_REPLY).state, FINAL_REPLY_TIMEOUT);
    EXPECT_EQ(tickGet(), 32u);
  });
}

TEST(CsLib, AReportBecomesTheClientsErrorCode) {
  with_server([](CLIENT_ID client) {
    EXPECT_EQ(receive(client, send(client, refuse, 0), BLOCK_ON_FINAL_REPLY).state, ERROR);
    EXPECT_EQ(error_name(), "S_800_5");
    EXPECT_EQ(receive(client, send(client, unknown, 0), BLOCK_ON_FINAL_REPLY).state, ERROR);
    EXPECT_EQ(error_name(), "S_csLib_INVALID_RQST_TYPE");
  });
}

TEST(CsLib, AClientHasTwentyRequestsAtATime) {
  with_server([](CLIENT_ID client) {
    std::vector<int> ids;
    ids.reserve(CLIENT_NMAX_RQST_ID);
    for (int i = 0; i < CLIENT_NMAX_RQST_ID; ++i) ids.push_back(send(client, add_one, i));
    int value = 0, id = 0;
    EXPECT_EQ(csClientRqstSend(client, add_one, reinterpret_cast<char*>(&value), 4, nullptr, FALSE, 0, 0, &id), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_TOO_MANY_RQST_IDS");
    for (int i = CLIENT_NMAX_RQST_ID; i-- > 0;) {  // the replies are kept until they are asked for
      const Received got = receive(client, ids[static_cast<std::size_t>(i)], BLOCK_ON_FINAL_REPLY);
      EXPECT_EQ(got.state, FINAL_REPLY_OK);
      EXPECT_EQ(got.final, i + 1);
    }
    EXPECT_EQ(send(client, add_one, 0), ids[0]);
    EXPECT_EQ(receive(client, ids[0], BLOCK_ON_FINAL_REPLY).final, 1);
  });
}

TEST(CsLib, AServerHasTwentyRequestsAtATime) {
  with_clock([] {
    SERV_ID server = nullptr;
    CLIENT_ID client = nullptr;
    ASSERT_EQ(csMboxInit("self", mailbox_size, mailbox_size), OK);
    ASSERT_EQ(csServInit(most, most, &server), OK);
    ASSERT_EQ(csServFuncInstall(server, keep, do_keep), OK);
    ASSERT_EQ(csClientInit("self", most, 0, most, &client), OK);
    for (int i = 0; i < SERV_NMAX_RQST_ID; ++i) {
      send(client, keep, i);
      EXPECT_EQ(csServRqstExec(server), OK);
    }
    EXPECT_EQ(csServRqstExec(server), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_TOO_MANY_RQST_IDS");
    EXPECT_EQ(csServRqstIdFree(server, 3), OK);
    EXPECT_EQ(csServRqstIdFree(server, 3), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_BAD_RQST_ID");
    // The input of the one that is executed last; replies to any.
    int value = 0;
    EXPECT_EQ(csServRqstParamsGet(server, 19, reinterpret_cast<char*>(&value), 4, nullptr), OK);
    EXPECT_EQ(csServRqstParamsGet(server, 18, reinterpret_cast<char*>(&value), 4, nullptr), ERROR);
    EXPECT_EQ(reply(server, 7, FINAL_REPLY, 70), OK);
    EXPECT_EQ(receive(client, 7, NO_BLOCK).final, 70);
    EXPECT_EQ(csServEnd(server), OK);
    EXPECT_EQ(csServEnd(server), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_NOT_A_SERV");
  });
}

TEST(CsLib, ATaskWaitsForRequestsRepliesOrBoth) {
  with_server([](CLIENT_ID client) {
    EXPECT_EQ(csMboxStatus(REPLY_MBOX), 0);
    EXPECT_EQ(csMboxWait(2, REPLY_MBOX), 0);
    EXPECT_EQ(tickGet(), 3u);
    const int id = send(client, slowly, 1, true);
    EXPECT_EQ(csMboxWait(0, REPLY_MBOX), REPLY_MBOX);
    EXPECT_EQ(tickGet(), 8u);
    EXPECT_EQ(csMboxStatus(REPLY_MBOX), REPLY_MBOX);
    receive(client, id, BLOCK_ON_FINAL_REPLY);
    EXPECT_EQ(csMboxStatus(REPLY_MBOX), 0);
    EXPECT_EQ(csMboxStatus(4), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_ERR_MBOX_MASK");
    EXPECT_EQ(csMboxWait(0, 0), ERROR);
  });
  with_clock([] {
    ASSERT_EQ(csMboxInit("both", mailbox_size, mailbox_size), OK);
    EXPECT_EQ(csMboxWait(2, RCV_MBOX | REPLY_MBOX), 0);
    thread sender = start_task("sender", [] {
      MBOX_ID to = 0;
      char text[] = "a";
      mboxFind("both", &to);
      mboxSend(to, 0, text, 2);
    });
    EXPECT_EQ(csMboxWait(0, RCV_MBOX | REPLY_MBOX), RCV_MBOX);
    sender.join();
    EXPECT_EQ(csMboxUpdate(2 * mailbox_size, 0), OK);
    EXPECT_EQ(csMboxUpdate(0, 1), ERROR);
  });
}

int twice_coded(char* from, int bytes, char* to, int room) {
  if (room < 2 * bytes) return ERROR;
  for (std::ptrdiff_t i = 0; i < bytes; ++i) to[2 * i] = to[2 * i + 1] = from[i];
  return 2 * bytes;
}

TEST(CsLib, DataAreCodedByTheUsersFunctions) {
  with_server([](CLIENT_ID client) {
    char one = 1;
    int id = 0;
    // Two bytes of 1 for the input, of which the server takes four.
    EXPECT_EQ(csClientRqstSend(client, add_one, &one, 1, twice_coded, FALSE, 0, 0, &id), OK);
    std::array<char, 8> bytes{};
    EXPECT_EQ(csClientReplyRcv(client, id, BLOCK_ON_FINAL_REPLY, nullptr, 0, nullptr, bytes.data(), 8, twice_coded),
              FINAL_REPLY_OK);
    EXPECT_EQ(bytes, (std::array<char, 8>{2, 2, 1, 1, 0, 0, 0, 0}));
    std::array<char, most> large{};
    EXPECT_EQ(csClientRqstSend(client, add_one, large.data(), most, twice_coded, FALSE, 0, 0, &id), ERROR);
  });
}

TEST(CsLib, MistakesAreErrors) {
  with_server([](CLIENT_ID client) {
    CLIENT_ID other = nullptr;
    EXPECT_EQ(csClientInit("nowhere", 4, 4, 4, &other), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_NOT_FOUND");
    std::array<char, most + 1> large{};
    int id = 0;
    EXPECT_EQ(csClientRqstSend(client, add_one, large.data(), most + 1, nullptr, FALSE, 0, 0, &id), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_SMALL_LETTER");
    EXPECT_EQ(csClientRqstSend(client, add_one, large.data(), 4, nullptr, 2, 0, 0, &id), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_BAD_INTERMED_FLAG");
    id = send(client, add_one, 1);
    EXPECT_EQ(receive(client, id, 9).state, ERROR);
    EXPECT_EQ(error_name(), "S_csLib_BAD_BLOCK_TYPE");
    EXPECT_EQ(csClientReplyRcv(client, id, BLOCK_ON_FINAL_REPLY, nullptr, 0, nullptr, large.data(), 3, nullptr), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_SMALL_DATA_STR");
    EXPECT_EQ(csClientRqstIdFree(client, -1), ERROR);
    EXPECT_EQ(csClientEnd(nullptr), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_NOT_A_CLIENT");
    SERV_ID server = nullptr;
    csServInitN(4, 4, 2, &server);
    EXPECT_EQ(csServFuncInstall(server, 2, do_keep), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_INVALID_RQST_TYPE");
    EXPECT_EQ(csServReplySend(server, 0, FINAL_REPLY, OK, nullptr, 0, nullptr), ERROR);
    EXPECT_EQ(csServRqstExec(nullptr), ERROR);
  });
}

TEST(CsLib, AnIntermediateReplyHasNoReport) {
  with_clock([] {
    SERV_ID server = nullptr;
    CLIENT_ID client = nullptr;
    csMboxInit("self", mailbox_size, mailbox_size);
    csServInit(most, 4, &server);
    csServFuncInstall(server, keep, do_keep);
    csClientInit("self", most, 4, 4, &client);
    send(client, keep, 1, true);
    csServRqstExec(server);
    EXPECT_EQ(reply(server, 0, INTERMED_REPLY, 0, 1), ERROR);
    EXPECT_EQ(error_name(), "S_csLib_BAD_REPLY_BILAN");
    EXPECT_EQ(reply(server, 0, 3, 0), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_REPLY_LETTER_TYPE");
    std::array<char, 5> large{};
    EXPECT_EQ(csServReplySend(server, 0, FINAL_REPLY, OK, large.data(), 5, nullptr), ERROR);
    EXPECT_EQ(error_name(), "S_gcomLib_SMALL_LETTER");
  });
}

}  // namespace
}  // namespace waitpoint
