// SPDX-License-Identifier: BSD-3-Clause
// Messages in several parts, several messages per call, and waits for complete requests.
#include "tests/exec/conformance/sockets.h"

CASE(several_messages_are_sent_and_received_by_one_call) {
  make_pair(SOCK_DGRAM);
  char from[3] = "ab", to[3] = "..";
  struct iovec sent[2] = {{from, 1}, {from + 1, 1}}, got[2] = {{to, 1}, {to + 1, 1}};
  struct mmsghdr out[2] = {{{.msg_iov = &sent[0], .msg_iovlen = 1}, 0}, {{.msg_iov = &sent[1], .msg_iovlen = 1}, 0}};
  struct mmsghdr in[3] = {{{.msg_iov = &got[0], .msg_iovlen = 1}, 0}, {{.msg_iov = &got[1], .msg_iovlen = 1}, 0}};
  EXPECT_IS(sendmmsg(ends[1], out, 2, 0), 2);
  EXPECT_IS(out[1].msg_len, 1);
  EXPECT_IS(recvmmsg(ends[0], in, 3, MSG_WAITFORONE, NULL), 2);
  EXPECT_IS(to[0] == 'a' && to[1] == 'b' && in[0].msg_len == 1, 1);
  EXPECT_FAILS(recvmmsg(ends[0], in, 1, MSG_DONTWAIT, NULL), EAGAIN);
  EXPECT_FAILS(sendmmsg(-1, out, 2, 0), EBADF);
}

static void* send_a_message(void* unused) {
  struct iovec part = {"x", 1};
  struct mmsghdr message = {{.msg_iov = &part, .msg_iovlen = 1}, 0};
  let_others_wait();
  EXPECT_IS(sendmmsg(ends[1], &message, 1, 0), 1);
  return unused;
}
CASE(recvmmsg_waits) {
  make_pair(SOCK_DGRAM);
  char byte = 0;
  struct iovec part = {&byte, 1};
  struct mmsghdr message = {{.msg_iov = &part, .msg_iovlen = 1}, 0};
  const pthread_t id = start(send_a_message, NULL);
  EXPECT_IS(recvmmsg(ends[0], &message, 1, 0, NULL), 1);
  EXPECT_IS(byte, 'x');
  join(id);
}
CASE(recvmsg_waits) {
  make_pair(SOCK_STREAM);
  char byte = 0;
  struct iovec part = {&byte, 1};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1};
  const pthread_t id = start(send_one, NULL);
  EXPECT_IS(recvmsg(ends[0], &message, 0), 1);
  EXPECT_IS(byte, 'x');
  join(id);
}

static void* send_in_pieces(void* unused) {
  for (int i = 0; i < 4; ++i) {
    sleep_ms(1);
    EXPECT_IS(send(ends[1], "ab", 2, 0), 2);
  }
  return unused;
}
CASE(WAITALL_waits_for_all) {
  make_pair(SOCK_STREAM);
  char text[9] = "";
  const pthread_t id = start(send_in_pieces, NULL);
  EXPECT_IS(recv(ends[0], text, 8, MSG_WAITALL), 8);
  EXPECT_IS(strcmp(text, "abababab"), 0);
  join(id);
}

static void* send_two_and_close(void* unused) {
  EXPECT_IS(send(ends[1], "ab", 2, 0), 2);
  let_others_wait();
  close(ends[1]);
  return unused;
}
CASE(WAITALL_gives_what_came_before_the_end) {
  make_pair(SOCK_STREAM);
  char text[9] = "";
  const pthread_t id = start(send_two_and_close, NULL);
  EXPECT_IS(recv(ends[0], text, 8, MSG_WAITALL), 2);
  EXPECT_IS(recv(ends[0], text, 8, MSG_WAITALL), 0);
  join(id);
}
CASE(sendmsg_waits_for_room) {
  make_pair(SOCK_STREAM);
  fill_big();
  struct iovec parts[] = {{big, 1000000}, {big + 1000000, sizeof big - 1000000}};
  const struct msghdr message = {.msg_iov = parts, .msg_iovlen = 2};
  const pthread_t id = start(receive_big, &ends[0]);
  EXPECT_IS(sendmsg(ends[1], &message, 0), (long long)sizeof big);
  join(id);
}
CASE(sendmsg_and_recvmsg_take_parts) {
  make_pair(SOCK_STREAM);
  char first[3] = "", second[8] = "";
  struct iovec out[] = {{"abc", 3}, {"de", 2}}, in[] = {{first, 2}, {second, 7}};
  const struct msghdr message = {.msg_iov = out, .msg_iovlen = 2};
  struct msghdr received = {.msg_iov = in, .msg_iovlen = 2};
  EXPECT_IS(sendmsg(ends[1], &message, 0), 5);
  EXPECT_IS(recvmsg(ends[0], &received, 0), 5);
  EXPECT_IS(strcmp(first, "ab"), 0);
  EXPECT_IS(strcmp(second, "cde"), 0);
}
CASE(descriptors_can_be_sent) {
  make_pair(SOCK_STREAM);
  int pipe_ends[2];
  EXPECT_IS(pipe(pipe_ends), 0);
  char byte = 'd';
  union {
    char bytes[CMSG_SPACE(sizeof(int))];
    struct cmsghdr header;
  } control;
  memset(&control, 0, sizeof control);
  struct iovec part = {&byte, 1};
  struct msghdr message = {
      .msg_iov = &part, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
  struct cmsghdr* const header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof(int));
  memcpy(CMSG_DATA(header), &pipe_ends[1], sizeof(int));
  EXPECT_IS(sendmsg(ends[1], &message, 0), 1);
  memset(&control, 0, sizeof control);
  message.msg_controllen = sizeof control;
  EXPECT_IS(recvmsg(ends[0], &message, 0), 1);
  int received = -1;
  memcpy(&received, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof received);
  EXPECT(received >= 0 && received != pipe_ends[1]);
  EXPECT_IS(write(received, "x", 1), 1);
  EXPECT_IS(read(pipe_ends[0], &byte, 1), 1);
}

static int filled[2];

static void* empty_it(void* unused) {
  char bytes[64];
  let_others_wait();
  note("r");
  while (recv(filled[1], bytes, sizeof bytes, MSG_DONTWAIT) > 0) {
  }
  return unused;
}
CASE(several_messages_wait_for_room) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_DGRAM, 0, filled), 0);
  while (send(filled[0], "full", 4, MSG_DONTWAIT) == 4) {
  }
  struct iovec part = {"more", 4};
  struct mmsghdr both[2];
  memset(both, 0, sizeof both);
  both[0].msg_hdr.msg_iov = both[1].msg_hdr.msg_iov = &part;
  both[0].msg_hdr.msg_iovlen = both[1].msg_hdr.msg_iovlen = 1;
  const pthread_t id = start(empty_it, NULL);
  EXPECT(sendmmsg(filled[0], both, 2, 0) >= 1);
  note("s");
  join(id);
  EXPECT_NOTED("rs");
}
