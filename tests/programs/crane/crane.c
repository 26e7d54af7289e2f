/* SPDX-License-Identifier: BSD-3-Clause */
/* A program written to the API of pocolibs: a crane that serves requests and writes a poster, and a client that sends
 * requests and reads it. Nothing here is waitpoint's. What it prints is the same with either library. */
#include <stdio.h>

#include <commonStructLib.h>
#include <csLib.h>
#include <errnoLib.h>
#include <h2devLib.h>
#include <h2evnLib.h>
#include <h2initGlob.h>
#include <h2timerLib.h>
#include <portLib.h>
#include <posterLib.h>
#include <symLib.h>
#include <taskLib.h>
#include <tickLib.h>
#include <wdLib.h>

#define M_crane 701
#define S_crane_INTERRUPTED H2_ENCODE_ERR(M_crane, 1)
#define S_crane_TOO_HIGH H2_ENCODE_ERR(M_crane, 2)
static const H2_ERROR errors[] = {{"INTERRUPTED", 1}, {"TOO_HIGH", 2}};

enum { LIFT, STOP };
enum { MBOX_SIZE = 2048, PERIOD = 5, NONE = -1 };

typedef struct {
  int height_cm;
  int lifting;
} CRANE_STATE;

int crane_height_max_cm = 200; /* found by its name */

static SERV_ID server;
static POSTER_ID state_poster;
static CRANE_STATE *state; /* a common structure */
static int active_request, target_cm;
static SEM_ID ready;

static const char *error_name(void) {
  static char text[64];
  return h2getErrMsg(errnoGet(), text, sizeof(text));
}

/* --- the crane ------------------------------------------------------------------------------------------------------ */

static void finish(int report) {
  int height_cm = state->height_cm;
  csServReplySend(server, active_request, FINAL_REPLY, report, (char *)&height_cm, sizeof(height_cm), NULL);
  active_request = NONE;
}

static void lift(SERV_ID serv, int rqstId) {
  int height_cm;
  csServRqstParamsGet(serv, rqstId, (char *)&height_cm, sizeof(height_cm), NULL);
  if (height_cm > crane_height_max_cm) {
    csServReplySend(serv, rqstId, FINAL_REPLY, S_crane_TOO_HIGH, NULL, 0, NULL);
    return;
  }
  if (active_request != NONE) finish(S_crane_INTERRUPTED);
  active_request = rqstId;
  target_cm = height_cm;
  csServReplySend(serv, rqstId, INTERMED_REPLY, OK, (char *)&rqstId, sizeof(rqstId), NULL);
}

static void stop(SERV_ID serv, int rqstId) {
  if (active_request != NONE) finish(S_crane_INTERRUPTED);
  csServReplySend(serv, rqstId, FINAL_REPLY, OK, NULL, 0, NULL);
}

static void move(void) {
  CRANE_STATE now;
  commonStructTake(state);
  if (active_request != NONE && state->height_cm != target_cm) state->height_cm += state->height_cm < target_cm ? 10 : -10;
  state->lifting = active_request != NONE;
  commonStructGive(state);
  commonStructCopy(state, TO, &now);
  posterWrite(state_poster, 0, &now, sizeof(now));
  if (active_request != NONE && now.height_cm == target_cm) finish(OK);
}

static void *crane(void *unused) {
  H2TIMER_ID timer = h2timerAlloc();
  (void)unused;
  if (csMboxInit("crane", MBOX_SIZE, 0) != OK || csServInit(64, 64, &server) != OK) return NULL;
  csServFuncInstall(server, LIFT, lift);
  csServFuncInstall(server, STOP, stop);
  posterCreate("craneState", sizeof(CRANE_STATE), &state_poster);
  semGive(ready);
  h2timerStart(timer, PERIOD, 0);
  FOREVER {
    h2timerPause(timer);
    while (csMboxStatus(RCV_MBOX) == RCV_MBOX) csServRqstExec(server);
    move();
  }
  return NULL;
}

/* --- the client ----------------------------------------------------------------------------------------------------- */

static int send_lift(CLIENT_ID client, int height_cm, int timeout) {
  int id = NONE;
  if (csClientRqstSend(client, LIFT, (char *)&height_cm, sizeof(height_cm), NULL, TRUE, 0, timeout, &id) != OK)
    printf("lift: not sent: %s\n", error_name());
  return id;
}

static int receive(CLIENT_ID client, int id, int block, int *height_cm) {
  int activity;
  return csClientReplyRcv(client, id, block, (char *)&activity, sizeof(activity), NULL, (char *)height_cm,
                          sizeof(*height_cm), NULL);
}

static void requests(CLIENT_ID client) {
  int height_cm = 0, id, second, status;

  id = send_lift(client, 50, 0);
  printf("lift 50: before the intermediate reply: %d\n", receive(client, id, NO_BLOCK, &height_cm));
  status = receive(client, id, BLOCK_ON_INTERMED_REPLY, &height_cm);
  printf("lift 50: after the intermediate reply: %d\n", status);
  status = receive(client, id, BLOCK_ON_FINAL_REPLY, &height_cm);
  printf("lift 50: final: %d, %d cm\n", status, height_cm);

  id = send_lift(client, 500, 0);
  status = receive(client, id, BLOCK_ON_FINAL_REPLY, &height_cm);
  printf("lift 500: %d, %s\n", status, status == ERROR ? error_name() : "");

  id = send_lift(client, 100, 12);
  status = receive(client, id, BLOCK_ON_FINAL_REPLY, &height_cm);
  printf("lift 100 within 12 ticks: %d\n", status);

  second = send_lift(client, 150, 0);
  receive(client, second, BLOCK_ON_INTERMED_REPLY, &height_cm);
  csClientRqstSend(client, STOP, NULL, 0, NULL, FALSE, 0, 0, &id);
  status = receive(client, second, BLOCK_ON_FINAL_REPLY, &height_cm);
  printf("lift 150, stopped: %d, %s\n", status, status == ERROR ? error_name() : "");
  printf("stop: %d\n", csClientReplyRcv(client, id, BLOCK_ON_FINAL_REPLY, NULL, 0, NULL, NULL, 0, NULL));
  status = receive(client, id, NO_BLOCK, &height_cm);
  printf("stop, received again: %d, %s\n", status, error_name());
}

static void posters(void) {
  POSTER_ID found, empty, again;
  CRANE_STATE seen;
  H2_POSTER_STAT_STR accesses;
  size_t size;
  int fresh, bytes, status;
  unsigned long age_ms;

  posterCreate("empty", 8, &empty);
  bytes = posterRead(empty, 0, &seen, 8);
  printf("empty: %d, %s\n", bytes, error_name());
  posterIoctl(empty, FIO_FRESH, &fresh);
  printf("fresh: %d\n", fresh);
  status = posterCreate("empty", 8, &again);
  printf("created again: %d, %s\n", status, error_name());
  printf("deleted: %d", posterDelete(empty));
  bytes = posterRead(empty, 0, &seen, 8);
  printf(", then read: %d, %s\n", bytes, error_name());

  posterFind("craneState", &found);
  printf("%s: %d bytes\n", posterName(found), posterRead(found, 0, &seen, sizeof(seen)));
  printf("lifting: %d\n", seen.lifting);
  bytes = posterRead(found, sizeof(int), &seen, 100);
  printf("from the second field: %d bytes\n", bytes);
  bytes = posterRead(found, sizeof(seen), &seen, 1);
  printf("behind it: %d, %s\n", bytes, error_name());
  posterIoctl(found, FIO_GETSIZE, &size);
  posterIoctl(found, FIO_NMSEC, &age_ms);
  printf("%lu bytes, written within a period: %d\n", (unsigned long)size, age_ms <= 1000 * PERIOD / 100);
  posterIoctl(found, FIO_GETSTATS, &accesses);
  printf("%u reads of %u bytes, written: %d\n", accesses.read_ops, accesses.read_bytes, accesses.write_ops > 0);
  posterTake(found, POSTER_READ);
  printf("by its address: %d\n", ((CRANE_STATE *)posterAddr(found))->lifting);
  posterGive(found);
  status = posterIoctl(found, 99, &size);
  printf("unknown code: %d, %s\n", status, error_name());
}

static void mailboxes(void) {
  MBOX_ID box, from;
  char text[32];
  int sent = 0, count, bytes, status;

  mboxCreate("letters", 100, &box);
  while (mboxSend(box, box, "abcdef", 7) == OK) ++sent;
  printf("%d letters, then %s\n", sent, error_name());
  mboxIoctl(box, FIO_NMSGS, &count);
  mboxIoctl(box, FIO_NBYTES, &bytes);
  printf("%d letters of %d bytes\n", count, bytes);
  bytes = mboxRcv(box, &from, text, sizeof(text), 0);
  printf("%d bytes: %s, from itself: %d\n", bytes, text, from == box);
  bytes = mboxRcv(box, &from, text, 3, 0);
  printf("in too small a buffer: %d, %s\n", bytes, error_name());
  bytes = mboxRcv(box, &from, text, sizeof(text), 2);
  printf("without letters, 2 ticks: %d, %s\n", bytes, error_name());
  status = mboxFind("nothing", &box);
  printf("unknown: %d, %s\n", status, error_name());
}

static void bark(long task) { h2evnSignal(task); }

static void others(void) {
  char *address;
  SYM_TYPE type;
  WDOG_ID dog = wdCreate();
  unsigned long begin;
  int status;

  printf("symbol: %d", symFindByName(sysSymTbl, "crane_height_max_cm", &address, &type));
  printf(", %d cm\n", *(int *)address);
  status = symFindByName(sysSymTbl, "no_such_symbol", &address, &type);
  printf("unknown symbol: %d, %s\n", status, error_name());
  h2evnClear();
  begin = tickGet();
  wdStart(dog, 7, bark, taskIdSelf());
  printf("event: %d", h2evnSusp(100));
  printf(", after 7 ticks: %d\n", tickGet() - begin >= 7 && tickGet() - begin <= 8);
  status = h2evnSusp(3);
  printf("none within 3 ticks: %d, %s\n", status, error_name());
}

int main(void) {
  CLIENT_ID client;

  h2devEnd();
  if (h2devInit(1024 * 1024, H2_DEV_MAX_DEFAULT, FALSE) == ERROR || h2initGlob(100) == ERROR) {
    printf("no h2 devices: %s\n", error_name());
    return 2;
  }
  h2recordErrMsgs("main", "crane", M_crane, 2, errors);
  active_request = NONE;
  ready = semBCreate(0, SEM_EMPTY);
  commonStructCreate(sizeof(CRANE_STATE), (void **)&state);
  taskSpawn2("tCrane", 100, VX_FP_TASK, 20000, crane, NULL);
  semTake(ready, WAIT_FOREVER);

  if (csMboxInit("client", 0, MBOX_SIZE) != OK || csClientInit("crane", 64, 64, 64, &client) != OK) {
    printf("no client: %s\n", error_name());
    return 1;
  }
  requests(client);
  taskDelay(2 * PERIOD);
  posters();
  mailboxes();
  others();
  csClientEnd(client);
  csMboxEnd();
  h2devEnd();
  return 0;
}
