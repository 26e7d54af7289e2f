/* SPDX-License-Identifier: BSD-3-Clause */
/* Written to the API of pocolibs, with a bug that few schedules show: a client frees the number of a request that timed
 * out and sends another; the reply to the first, which comes after all, is taken for the reply to the second. */
#include <csLib.h>
#include <errnoLib.h>
#include <h2initGlob.h>
#include <portLib.h>
#include <stddef.h>
#include <taskLib.h>

enum { TWICE, MBOX_SIZE = 1024, TAKES_TICKS = 4 };

static SEM_ID ready;

static void twice(SERV_ID server, int id) {
  int number = 0;
  csServRqstParamsGet(server, id, (char *)&number, sizeof(number), NULL);
  number *= 2;
  taskDelay(TAKES_TICKS);
  csServReplySend(server, id, FINAL_REPLY, OK, (char *)&number, sizeof(number), NULL);
}

static void *serve(void *unused) {
  SERV_ID server;
  (void)unused;
  if (csMboxInit("twice", MBOX_SIZE, 0) != OK || csServInit(16, 16, &server) != OK) return NULL;
  csServFuncInstall(server, TWICE, twice);
  semGive(ready);
  FOREVER csServRqstExec(server);
  return NULL;
}

/* Asks until there is an answer, which is to be that to the last question. */
static int ask(CLIENT_ID client) {
  int id, number, result = 0;
  for (number = 21;; ++number) {
    csClientRqstSend(client, TWICE, (char *)&number, sizeof(number), NULL, FALSE, 0, TAKES_TICKS - 1, &id);
    taskDelay(0);
    if (csClientReplyRcv(client, id, BLOCK_ON_FINAL_REPLY, NULL, 0, NULL, (char *)&result, sizeof(result), NULL) ==
        FINAL_REPLY_OK)
      return result == 2 * number ? 0 : 1;
    csClientRqstIdFree(client, id);
  }
}

int main(void) {
  CLIENT_ID client;
  if (h2initGlob(100) != OK) return 2;
  ready = semBCreate(0, SEM_EMPTY);
  taskSpawn2("tTwice", 100, 0, 20000, serve, NULL);
  semTake(ready, WAIT_FOREVER);
  if (csMboxInit("asker", 0, MBOX_SIZE) != OK || csClientInit("twice", 16, 0, 16, &client) != OK) return 2;
  return ask(client);
}
