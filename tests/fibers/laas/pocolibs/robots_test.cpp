// SPDX-License-Identifier: BSD-3-Clause
// Each robot has its own names, numbers and memory, which are new in each run.
#include <vector>

#include "fibers/laas/include/csLib.h"
#include "fibers/laas/include/posterLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

constexpr int mailbox_size = 1024;

void write_poster(SERV_ID server, int id) {
  int value = 0;
  POSTER_ID poster = nullptr;
  csServRqstParamsGet(server, id, reinterpret_cast<char*>(&value), sizeof value, nullptr);
  posterFind("value", &poster);
  posterWrite(poster, 0, &value, sizeof value);
  csServReplySend(server, id, FINAL_REPLY, OK, nullptr, 0, nullptr);
}

void* serve(void* ready) {
  SERV_ID server = nullptr;
  if (csMboxInit("server", mailbox_size, 0) != OK || csServInit(16, 16, &server) != OK) return nullptr;
  csServFuncInstall(server, 0, write_poster);
  semGive(static_cast<SEM_ID>(ready));
  for (;;) csServRqstExec(server);
}

// A server that writes a poster, and two clients that read it.
void robot(int rate, int first_value) {
  ASSERT_EQ(h2initGlob(rate), OK);
  POSTER_ID poster = nullptr;
  ASSERT_EQ(posterCreate("value", sizeof(int), &poster), OK);
  const SEM_ID ready = semBCreate(SEM_Q_FIFO, SEM_EMPTY);
  EXPECT_EQ(taskSpawn2("tServer", 10, 0, 20000, serve, ready), 1);
  semTake(ready, WAIT_FOREVER);
  std::vector<thread> clients;
  for (const char* name : {"one", "two"})
    clients.push_back(start_task(name, [=] {
      CLIENT_ID client = nullptr;
      ASSERT_EQ(csMboxInit(name, 0, mailbox_size), OK);
      ASSERT_EQ(csClientInit("server", 16, 0, 16, &client), OK);
      for (int value = first_value; value < first_value + 5; ++value) {
        int copy = value, id = 0;
        csClientRqstSend(client, 0, reinterpret_cast<char*>(&copy), sizeof copy, nullptr, FALSE, 0, 0, &id);
        EXPECT_EQ(csClientReplyRcv(client, id, BLOCK_ON_FINAL_REPLY, nullptr, 0, nullptr, nullptr, 0, nullptr),
                  FINAL_REPLY_OK);
        EXPECT_EQ(posterRead(poster, 0, &copy, sizeof copy), 4);
        EXPECT_GE(copy, first_value);
        EXPECT_LT(copy, first_value + 5);
        taskDelay(1);
      }
    }));
  for (thread& client : clients) client.join();
}

std::uint64_t digest_of_dala(std::uint64_t number, bool with_other) {
  Simulation simulation(order_number(number));
  kernel::Robot& dala = simulation.add_robot("dala");
  if (with_other) simulation.spawn(simulation.add_robot("rackham"), {}, [] { robot(250, 100); });
  simulation.spawn(dala, {}, [] { robot(100, 0); });
  EXPECT_EQ(simulation.run_before(), RunEnd::ended) << simulation.trouble();
  return dala.digest.value();
}

TEST(PocolibsRobots, DigestsRepeatInEveryOrderAlsoBesideAnotherRobot) {
  std::vector<std::uint64_t> digests;
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    digests.push_back(digest_of_dala(number, false));
    ASSERT_EQ(digest_of_dala(number, false), digests.back()) << number;
    ASSERT_EQ(digest_of_dala(number, true), digests.back()) << number;
  }
  EXPECT_NE(digests[1], digests[2]);
}

// A run that ends with tasks in every kind of wait, in frames of C functions.
TEST(PocolibsRobots, ARunLeftInTheMiddleIsUnwound) {
  for (int ms = 0; ms < 60; ms += 7) {
    Simulation simulation;
    simulation.spawn(simulation.add_robot("dala"), {}, [] { robot(100, 0); });
    simulation.run_before(Time() + Duration(std::chrono::milliseconds(ms)));
    simulation.unwind();
    EXPECT_TRUE(simulation.abandoned().empty());
  }
}

}  // namespace
}  // namespace waitpoint
