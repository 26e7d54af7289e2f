// SPDX-License-Identifier: BSD-3-Clause
// System V message queues.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <sys/msg.h>

static int queue = -1;
static atomic_int done;

struct letter {
  long type;
  char text[64];
};

static int make(void) {
  queue = msgget(IPC_PRIVATE, IPC_CREAT | 0600);
  EXPECT(queue >= 0);
  return queue;
}
static int unmake(void) { return msgctl(queue, IPC_RMID, NULL); }
static int send(long type, const char* text, int flags) {
  struct letter letter = {type, ""};
  strcpy(letter.text, text);
  return msgsnd(queue, &letter, strlen(text) + 1, flags);
}
static void expect_text(const char* file, int line, long wanted, int flags, long type, const char* text) {
  struct letter letter = {0, ""};
  const ssize_t size = msgrcv(queue, &letter, sizeof letter.text, wanted, flags);
  expect_equal(file, line, "size", size, (long long)strlen(text) + 1);
  expect_equal(file, line, "type", letter.type, type);
  expect_equal(file, line, text, strcmp(letter.text, text), 0);
}
#define EXPECT_LETTER(wanted, flags, type, text) expect_text(__FILE__, __LINE__, wanted, flags, type, text)
static struct msqid_ds status_of(int id) {
  struct msqid_ds status;
  EXPECT_IS(msgctl(id, IPC_STAT, &status), 0);
  return status;
}
static key_t some_key(void) { return (key_t)(0x59000000 | (getpid() & 0xFFFFFF)); }

CASE(a_key_leads_to_the_same_queue) {
  queue = msgget(some_key(), IPC_CREAT | 0600);
  EXPECT(queue >= 0);
  EXPECT_IS(msgget(some_key(), IPC_CREAT | 0600), queue);
  EXPECT_IS(msgget(some_key(), 0), queue);
  EXPECT_FAILS(msgget(some_key(), IPC_CREAT | IPC_EXCL | 0600), EEXIST);
  EXPECT_IS(unmake(), 0);
  EXPECT_FAILS(msgget(some_key(), 0600), ENOENT);
}
CASE(a_private_queue_is_new_each_time) {
  const int first = make(), second = make();
  EXPECT(first != second);
  EXPECT_IS(unmake(), 0);
  queue = first;
  EXPECT_IS(unmake(), 0);
}
CASE(messages_come_in_their_order) {
  make();
  EXPECT_IS(send(3, "first", 0), 0);
  EXPECT_IS(send(1, "second", 0), 0);
  EXPECT_IS(send(2, "third", 0), 0);
  EXPECT_LETTER(0, 0, 3, "first");
  EXPECT_LETTER(0, 0, 1, "second");
  EXPECT_LETTER(0, 0, 2, "third");
  unmake();
}
CASE(a_type_takes_the_first_of_it) {
  make();
  send(3, "a", 0), send(1, "b", 0), send(3, "c", 0), send(1, "d", 0);
  EXPECT_LETTER(1, 0, 1, "b");
  EXPECT_LETTER(3, 0, 3, "a");
  EXPECT_LETTER(1, 0, 1, "d");
  EXPECT_LETTER(3, 0, 3, "c");
  unmake();
}
CASE(a_negative_type_takes_the_least_up_to_it) {
  make();
  send(5, "five", 0), send(3, "three", 0), send(2, "two", 0), send(2, "two again", 0);
  EXPECT_LETTER(-4, 0, 2, "two");
  EXPECT_LETTER(-4, 0, 2, "two again");
  EXPECT_LETTER(-4, 0, 3, "three");
  struct letter letter;
  EXPECT_FAILS(msgrcv(queue, &letter, 64, -4, IPC_NOWAIT), ENOMSG);
  EXPECT_LETTER(-5, 0, 5, "five");
  unmake();
}
CASE(all_but_a_type_can_be_asked_for) {
  make();
  send(1, "one", 0), send(2, "two", 0);
  EXPECT_LETTER(1, MSG_EXCEPT, 2, "two");
  unmake();
}
CASE(receiving_refuses_what_is_too_long_but_with_MSG_NOERROR) {
  make();
  send(1, "longer than that", 0);
  struct letter letter = {0, "................"};
  EXPECT_FAILS(msgrcv(queue, &letter, 6, 0, 0), E2BIG);
  EXPECT_IS(status_of(queue).msg_qnum, 1);
  EXPECT_IS(msgrcv(queue, &letter, 6, 0, MSG_NOERROR), 6);
  EXPECT_IS(memcmp(letter.text, "longer..", 8), 0);
  EXPECT_IS(status_of(queue).msg_qnum, 0);
  unmake();
}
CASE(an_empty_message_has_a_type) {
  make();
  long type = 7;
  EXPECT_IS(msgsnd(queue, &type, 0, 0), 0);
  type = 0;
  EXPECT_IS(msgrcv(queue, &type, 0, 0, 0), 0);
  EXPECT_IS(type, 7);
  unmake();
}
CASE(sending_refuses_types_and_sizes) {
  make();
  static char bytes[20000];
  EXPECT_FAILS(send(0, "x", 0), EINVAL);
  EXPECT_FAILS(send(-1, "x", 0), EINVAL);
  *(long*)(void*)bytes = 1;
  EXPECT_FAILS(msgsnd(queue, bytes, 8193, 0), EINVAL);
  EXPECT_IS(msgsnd(queue, bytes, 8192, 0), 0);
  EXPECT_FAILS(msgrcv(queue, bytes, (size_t)-1, 0, 0), EINVAL);
  unmake();
  EXPECT_FAILS(send(1, "x", 0), EINVAL);
  EXPECT_FAILS(msgrcv(queue, bytes, 10, 0, 0), EINVAL);
  EXPECT_FAILS(unmake(), EINVAL);
}
CASE(what_is_full_takes_no_more_at_once) {
  make();
  static char bytes[8200];
  *(long*)(void*)bytes = 1;
  EXPECT_IS(msgsnd(queue, bytes, 8192, IPC_NOWAIT), 0);
  EXPECT_IS(msgsnd(queue, bytes, 8192, IPC_NOWAIT), 0);
  EXPECT_FAILS(send(1, "x", IPC_NOWAIT), EAGAIN);
  EXPECT_IS(msgrcv(queue, bytes, 8192, 0, 0), 8192);
  EXPECT_IS(send(1, "x", IPC_NOWAIT), 0);
  unmake();
}
CASE(what_is_empty_gives_none_at_once) {
  make();
  struct letter letter;
  EXPECT_FAILS(msgrcv(queue, &letter, 64, 0, IPC_NOWAIT), ENOMSG);
  EXPECT_IS(send(1, "x", 0), 0);
  EXPECT_FAILS(msgrcv(queue, &letter, 64, 2, IPC_NOWAIT), ENOMSG);
  unmake();
}

static void* receive_two(void* unused) {
  EXPECT_LETTER(2, 0, 2, "for two");
  atomic_fetch_add(&done, 1);
  return unused;
}
CASE(receiving_waits_for_its_type) {
  make();
  const pthread_t id = start(receive_two, NULL);
  let_others_wait();
  EXPECT_IS(send(1, "for one", 0), 0);
  let_others_wait();
  EXPECT_IS(done, 0);
  EXPECT_IS(status_of(queue).msg_qnum, 1);
  EXPECT_IS(send(2, "for two", 0), 0);
  join(id);
  EXPECT_IS(status_of(queue).msg_qnum, 1);
  unmake();
}
CASE(each_message_goes_to_one_of_those_that_wait) {
  make();
  pthread_t ids[3];
  for (int i = 0; i < 3; ++i) ids[i] = start(receive_two, NULL);
  let_others_wait();
  EXPECT_IS(send(2, "for two", 0), 0);
  let_others_wait();
  EXPECT_IS(done, 1);
  send(2, "for two", 0), send(2, "for two", 0);
  for (int i = 0; i < 3; ++i) join(ids[i]);
  unmake();
}
static void* send_more(void* unused) {
  static char bytes[8200];
  *(long*)(void*)bytes = 9;
  EXPECT_IS(msgsnd(queue, bytes, 8192, 0), 0);
  atomic_fetch_add(&done, 1);
  return unused;
}
CASE(sending_waits_for_room) {
  make();
  send_more(NULL);
  send_more(NULL);
  const pthread_t id = start(send_more, NULL);
  let_others_wait();
  EXPECT_IS(done, 2);
  static char bytes[8200];
  EXPECT_IS(msgrcv(queue, bytes, 8192, 0, 0), 8192);
  join(id);
  EXPECT_IS(done, 3);
  unmake();
}
static void* receive_until_removed(void* unused) {
  struct letter letter;
  EXPECT_FAILS(msgrcv(queue, &letter, 64, 0, 0), EIDRM);
  return unused;
}
static void* send_until_removed(void* unused) {
  static char bytes[8200];
  *(long*)(void*)bytes = 9;
  EXPECT_FAILS(msgsnd(queue, bytes, 8192, 0), EIDRM);
  return unused;
}
CASE(removal_ends_receiving) {
  make();
  const pthread_t id = start(receive_until_removed, NULL);
  let_others_wait();
  EXPECT_IS(unmake(), 0);
  join(id);
}
CASE(removal_ends_sending) {
  make();
  send_more(NULL);
  send_more(NULL);
  const pthread_t id = start(send_until_removed, NULL);
  let_others_wait();
  EXPECT_IS(unmake(), 0);
  join(id);
}
static void* receive_forever(void* unused) {
  struct letter letter;
  msgrcv(queue, &letter, 64, 0, 0);
  return unused;
}
CASE(receiving_is_a_cancellation_point) {
  make();
  const pthread_t id = start(receive_forever, NULL);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(send(1, "kept", 0), 0);
  EXPECT_IS(status_of(queue).msg_qnum, 1);
  unmake();
}
static void* send_forever(void* unused) {
  send_more(unused);
  return unused;
}
CASE(sending_is_a_cancellation_point) {
  make();
  send_more(NULL);
  send_more(NULL);
  const pthread_t id = start(send_forever, NULL);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(status_of(queue).msg_qnum, 2);
  unmake();
}
CASE(its_status_is_told) {
  const long long before = now_ns(CLOCK_REALTIME) / 1000000000;
  queue = msgget(some_key(), IPC_CREAT | 0640);
  struct msqid_ds status = status_of(queue);
  EXPECT_IS(status.msg_qnum, 0);
  EXPECT_IS(status.msg_qbytes, 16384);
  EXPECT_IS(status.msg_lspid, 0);
  EXPECT_IS(status.msg_stime, 0);
  EXPECT_IS(status.msg_perm.__key, some_key());
  EXPECT_IS(status.msg_perm.mode & 0777, 0640);
  EXPECT(status.msg_ctime >= before - 1);
  send(1, "four", 0);
  status = status_of(queue);
  EXPECT_IS(status.msg_qnum, 1);
  EXPECT_IS(status.__msg_cbytes, 5);
  EXPECT_IS(status.msg_lspid, getpid());
  EXPECT_IS(status.msg_lrpid, 0);
  EXPECT(status.msg_stime >= before - 1);
  EXPECT_LETTER(0, 0, 1, "four");
  status = status_of(queue);
  EXPECT_IS(status.msg_lrpid, getpid());
  EXPECT(status.msg_rtime >= before - 1);
  unmake();
}
CASE(its_size_can_be_set) {
  make();
  struct msqid_ds status = status_of(queue);
  status.msg_qbytes = 10;
  EXPECT_IS(msgctl(queue, IPC_SET, &status), 0);
  EXPECT_IS(status_of(queue).msg_qbytes, 10);
  EXPECT_IS(send(1, "nine char", IPC_NOWAIT), 0);
  EXPECT_FAILS(send(1, "x", IPC_NOWAIT), EAGAIN);
  unmake();
}
CASE(rights_are_those_of_the_mode) {
  make();
  struct letter letter;
  if (geteuid() == 0) EXPECT_IS(seteuid(12345), 0);
  if (geteuid() == 12345) {  // neither owner nor in the group
    EXPECT_FAILS(send(1, "x", 0), EACCES);
    EXPECT_FAILS(msgrcv(queue, &letter, 64, 0, IPC_NOWAIT), EACCES);
    EXPECT_FAILS(unmake(), EPERM);
    EXPECT_IS(seteuid(0), 0);
  }
  EXPECT_IS(unmake(), 0);
}
CASE(its_limits_are_told) {
  struct msginfo information;
  EXPECT(msgctl(0, IPC_INFO, (struct msqid_ds*)(void*)&information) >= 0);
  EXPECT_IS(information.msgmax, 8192);
  EXPECT_IS(information.msgmnb, 16384);
  EXPECT_FAILS(msgctl(0, 4711, NULL), EINVAL);
}
