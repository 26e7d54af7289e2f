// SPDX-License-Identifier: BSD-3-Clause
// Sockets: pairs, streams and datagrams of this machine.
#include "tests/exec/conformance/harness.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/un.h>

static int ends[2];
static atomic_int done, handled;
static char big[3000000];

static void make_pair(int type) { EXPECT_IS(socketpair(AF_UNIX, type, 0, ends), 0); }
static void fill_big(void) {
  for (size_t i = 0; i < sizeof big; ++i) big[i] = (char)(i * 7 + i / 1000);
}
static void* send_one(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_IS(send(ends[1], "x", 1, 0), 1);
  return unused;
}
static void* receive_big(void* descriptor) {
  static char received[sizeof big];
  let_others_wait();
  EXPECT_IS(recv(*(int*)descriptor, received, sizeof received, MSG_WAITALL), (long long)sizeof received);
  EXPECT_IS(memcmp(received, big, sizeof big), 0);
  return NULL;
}

CASE(recv_waits) {
  make_pair(SOCK_STREAM);
  char byte = 0;
  const pthread_t id = start(send_one, NULL);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 1);
  EXPECT_IS(byte, 'x');
  EXPECT_IS(done, 1);
  join(id);
}
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
CASE(nothing_waits_with_MSG_DONTWAIT) {
  make_pair(SOCK_STREAM);
  char byte = 0;
  EXPECT_FAILS(recv(ends[0], &byte, 1, MSG_DONTWAIT), EAGAIN);
  ssize_t count;
  while ((count = send(ends[1], big, 100000, MSG_DONTWAIT)) > 0) {
  }
  EXPECT_IS(count, -1);
  EXPECT_IS(errno, EAGAIN);
}
CASE(a_look_takes_nothing) {
  make_pair(SOCK_STREAM);
  char text[8] = "";
  EXPECT_IS(send(ends[1], "abc", 3, 0), 3);
  EXPECT_IS(recv(ends[0], text, 7, MSG_PEEK), 3);
  EXPECT_IS(recv(ends[0], text, 7, 0), 3);
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
CASE(send_waits_for_room) {
  make_pair(SOCK_STREAM);
  fill_big();
  const pthread_t id = start(receive_big, &ends[0]);
  EXPECT_IS(send(ends[1], big, sizeof big, MSG_NOSIGNAL), (long long)sizeof big);
  join(id);
}
CASE(write_waits_for_room) {
  make_pair(SOCK_STREAM);
  fill_big();
  const pthread_t id = start(receive_big, &ends[0]);
  EXPECT_IS(write(ends[1], big, sizeof big), (long long)sizeof big);
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
CASE(datagrams_keep_their_ends) {
  make_pair(SOCK_DGRAM);
  char text[8] = "";
  EXPECT_IS(send(ends[1], "abc", 3, 0), 3);
  EXPECT_IS(send(ends[1], "de", 2, 0), 2);
  EXPECT_IS(recv(ends[0], text, 2, 0), 2);
  EXPECT_IS(recv(ends[0], text, 8, 0), 2);
  EXPECT_IS(memcmp(text, "de", 2), 0);
}
static void* take_datagrams(void* unused) {
  char text[1000];
  let_others_wait();
  for (int i = 0; i < 1000; ++i) EXPECT_IS(recv(ends[0], text, sizeof text, 0), (long long)sizeof text);
  return unused;
}
CASE(datagrams_wait_for_room) {
  make_pair(SOCK_DGRAM);
  const pthread_t id = start(take_datagrams, NULL);
  for (int i = 0; i < 1000; ++i) EXPECT_IS(send(ends[1], big, 1000, 0), 1000);
  join(id);
}
CASE(a_time_to_receive_ends_it) {
  make_pair(SOCK_STREAM);
  const struct timeval timeout = {0, 20000};
  EXPECT_IS(setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout), 0);
  char byte;
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_FAILS(recv(ends[0], &byte, 1, 0), EAGAIN);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
  EXPECT_FAILS(read(ends[0], &byte, 1), EAGAIN);
  const pthread_t id = start(send_one, NULL);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 1);
  join(id);
}
CASE(a_time_to_send_ends_it) {
  make_pair(SOCK_STREAM);
  const struct timeval timeout = {0, 20000};
  EXPECT_IS(setsockopt(ends[1], SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout), 0);
  const ssize_t sent = send(ends[1], big, sizeof big, 0);
  EXPECT(sent > 0 && sent < (ssize_t)sizeof big);
  EXPECT_FAILS(send(ends[1], big, sizeof big, 0), EAGAIN);
}
static void* shut_down(void* unused) {
  let_others_wait();
  EXPECT_IS(shutdown(ends[1], SHUT_WR), 0);
  return unused;
}
CASE(shutdown_ends_receiving) {
  make_pair(SOCK_STREAM);
  char byte;
  const pthread_t id = start(shut_down, NULL);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 0);
  join(id);
  EXPECT_IS(send(ends[0], "x", 1, 0), 1);
  EXPECT_IS(recv(ends[1], &byte, 1, 0), 1);
  EXPECT_FAILS(shutdown(ends[0], 77), EINVAL);
}
static void count_signal(int signal) {
  (void)signal;
  atomic_fetch_add(&handled, 1);
}
CASE(sending_to_nobody_is_an_error_and_a_signal) {
  make_pair(SOCK_STREAM);
  signal(SIGPIPE, count_signal);
  close(ends[0]);
  EXPECT_FAILS(send(ends[1], "x", 1, 0), EPIPE);
  EXPECT_IS(handled, 1);
  EXPECT_FAILS(send(ends[1], "x", 1, MSG_NOSIGNAL), EPIPE);
  EXPECT_IS(handled, 1);
}
CASE(what_is_no_socket_is_refused) {
  int pipe_ends[2];
  char byte = 0;
  EXPECT_IS(pipe(pipe_ends), 0);
  EXPECT_FAILS(recv(pipe_ends[0], &byte, 1, 0), ENOTSOCK);
  EXPECT_FAILS(send(pipe_ends[1], &byte, 1, 0), ENOTSOCK);
  EXPECT_FAILS(recv(999, &byte, 1, 0), EBADF);
  EXPECT_FAILS(accept(999, NULL, NULL), EBADF);
  make_pair(SOCK_STREAM);
  EXPECT_FAILS(accept(ends[0], NULL, NULL), EINVAL);
}

// Of the internet, within the machine.

static struct sockaddr_in address;
static int listen_on(int type) {
  const int descriptor = socket(AF_INET, type, 0);
  EXPECT(descriptor >= 0);
  address = (struct sockaddr_in){.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  EXPECT_IS(bind(descriptor, (struct sockaddr*)&address, sizeof address), 0);
  if (type == SOCK_STREAM) EXPECT_IS(listen(descriptor, 5), 0);
  socklen_t size = sizeof address;
  EXPECT_IS(getsockname(descriptor, (struct sockaddr*)&address, &size), 0);
  return descriptor;
}
static void* connect_and_say(void* unused) {
  let_others_wait();
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_IS(connect(descriptor, (struct sockaddr*)&address, sizeof address), 0);
  char text[8] = "";
  EXPECT_IS(send(descriptor, "hello", 5, 0), 5);
  EXPECT_IS(recv(descriptor, text, 5, MSG_WAITALL), 5);
  EXPECT_IS(strcmp(text, "HELLO"), 0);
  EXPECT_IS(recv(descriptor, text, 5, 0), 0);
  close(descriptor);
  return unused;
}
CASE(a_server_speaks_with_its_client) {
  const int listening = listen_on(SOCK_STREAM);
  const pthread_t id = start(connect_and_say, NULL);
  struct sockaddr_in from;
  socklen_t size = sizeof from;
  const int descriptor = accept(listening, (struct sockaddr*)&from, &size);
  EXPECT(descriptor >= 0);
  EXPECT_IS(from.sin_family, AF_INET);
  char text[8] = "";
  EXPECT_IS(recv(descriptor, text, 5, MSG_WAITALL), 5);
  for (int i = 0; i < 5; ++i) text[i] = (char)(text[i] - 'a' + 'A');
  EXPECT_IS(send(descriptor, text, 5, 0), 5);
  close(descriptor);
  join(id);
}
CASE(accept4_sets_flags) {
  const int listening = listen_on(SOCK_STREAM);
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_IS(connect(client, (struct sockaddr*)&address, sizeof address), 0);
  const int descriptor = accept4(listening, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);
  char byte;
  EXPECT_FAILS(recv(descriptor, &byte, 1, 0), EAGAIN);
  EXPECT_IS(fcntl(descriptor, F_GETFD), FD_CLOEXEC);
  EXPECT_FAILS(accept4(listening, NULL, NULL, 0x1234), EINVAL);
}
CASE(a_stream_waits_for_room) {
  const int listening = listen_on(SOCK_STREAM);
  ends[1] = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_IS(connect(ends[1], (struct sockaddr*)&address, sizeof address), 0);
  ends[0] = accept(listening, NULL, NULL);
  fill_big();
  const pthread_t id = start(receive_big, &ends[0]);
  EXPECT_IS(send(ends[1], big, sizeof big, 0), (long long)sizeof big);
  join(id);
}
CASE(nobody_listens) {
  const int listening = listen_on(SOCK_STREAM);
  close(listening);
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_FAILS(connect(client, (struct sockaddr*)&address, sizeof address), ECONNREFUSED);
}
CASE(a_connection_may_be_waited_for_later) {
  const int listening = listen_on(SOCK_STREAM);
  const int client = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  const int result = connect(client, (struct sockaddr*)&address, sizeof address);
  EXPECT(result == 0 || errno == EINPROGRESS);
  struct pollfd one = {client, POLLOUT, 0};
  EXPECT_IS(poll(&one, 1, 1000), 1);
  int error = -1;
  socklen_t size = sizeof error;
  EXPECT_IS(getsockopt(client, SOL_SOCKET, SO_ERROR, &error, &size), 0);
  EXPECT_IS(error, 0);
  EXPECT((fcntl(client, F_GETFL) & O_NONBLOCK) != 0);
  EXPECT(accept(listening, NULL, NULL) >= 0);
  EXPECT_IS(fcntl(listening, F_SETFL, O_NONBLOCK), 0);
  EXPECT_FAILS(accept(listening, NULL, NULL), EAGAIN);
}
CASE(datagrams_say_where_they_are_from) {
  const int server = listen_on(SOCK_DGRAM);
  const struct sockaddr_in to = address;
  const int client = listen_on(SOCK_DGRAM);
  EXPECT_IS(sendto(client, "ping", 4, 0, (const struct sockaddr*)&to, sizeof to), 4);
  char text[8] = "";
  struct sockaddr_in from;
  socklen_t size = sizeof from;
  EXPECT_IS(recvfrom(server, text, sizeof text, 0, (struct sockaddr*)&from, &size), 4);
  EXPECT_IS(from.sin_port, address.sin_port);
  EXPECT_IS(sendto(server, "pong", 4, 0, (struct sockaddr*)&from, size), 4);
  EXPECT_IS(recvfrom(client, text, sizeof text, 0, NULL, NULL), 4);
  EXPECT_IS(memcmp(text, "pong", 4), 0);
}
static int waiting_server;
static void* send_datagram(void* unused) {
  let_others_wait();
  const int client = socket(AF_INET, SOCK_DGRAM, 0);
  EXPECT_IS(sendto(client, "late", 4, 0, (struct sockaddr*)&address, sizeof address), 4);
  return unused;
}
CASE(recvfrom_waits) {
  waiting_server = listen_on(SOCK_DGRAM);
  const pthread_t id = start(send_datagram, NULL);
  char text[8] = "";
  struct sockaddr_in from;
  socklen_t size = sizeof from;
  EXPECT_IS(recvfrom(waiting_server, text, sizeof text, 0, (struct sockaddr*)&from, &size), 4);
  join(id);
}

// Local ones with a name.

static struct sockaddr_un local;
static int listen_locally(int backlog) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
  memset(&local, 0, sizeof local);
  local.sun_family = AF_UNIX;
  snprintf(local.sun_path, sizeof local.sun_path, "/tmp/conformance-socket-%d", (int)getpid());
  unlink(local.sun_path);
  EXPECT_IS(bind(descriptor, (struct sockaddr*)&local, sizeof local), 0);
  EXPECT_IS(listen(descriptor, backlog), 0);
  return descriptor;
}
static int local_server;
static void* accept_three(void* unused) {
  let_others_wait();
  for (int i = 0; i < 3; ++i) EXPECT(accept(local_server, NULL, NULL) >= 0);
  return unused;
}
CASE(connecting_waits_for_room) {
  local_server = listen_locally(0);
  const pthread_t id = start(accept_three, NULL);
  for (int i = 0; i < 3; ++i) {
    const int client = socket(AF_UNIX, SOCK_STREAM, 0);
    EXPECT_IS(connect(client, (struct sockaddr*)&local, sizeof local), 0);
  }
  join(id);
  unlink(local.sun_path);
}

static void* send_many_to(void* address) {
  const int sender = socket(AF_UNIX, SOCK_DGRAM, 0);
  for (int i = 0; i < 600; ++i) EXPECT_IS(sendto(sender, big, 4096, 0, address, sizeof(struct sockaddr_un)), 4096);
  EXPECT_IS(close(sender), 0);
  return NULL;
}

CASE(sendto_waits_until_there_is_room) {
  struct sockaddr_un address = {AF_UNIX, ""};
  snprintf(address.sun_path + 1, sizeof address.sun_path - 1, "waitpoint-sendto-%d", (int)getpid());
  const int receiver = socket(AF_UNIX, SOCK_DGRAM, 0);
  EXPECT_IS(bind(receiver, (struct sockaddr*)&address, sizeof address), 0);
  const pthread_t id = start(send_many_to, &address);
  let_others_wait();
  static char bytes[4096];
  for (int i = 0; i < 600; ++i) EXPECT_IS(recv(receiver, bytes, sizeof bytes, 0), 4096);
  join(id);
}

// Noticed at once, not when all have nothing else to do.
static long long told_at_ns;
static void* receive_end(void* unused) {
  char byte;
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 0);
  told_at_ns = now_ns(CLOCK_MONOTONIC);
  return unused;
}

CASE(shutdown_wakes_who_receives) {
  make_pair(SOCK_STREAM);
  const pthread_t id = start(receive_end, NULL);
  let_others_wait();
  const long long begin_ns = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(shutdown(ends[1], SHUT_RDWR), 0);
  sleep_ms(200);
  join(id);
  EXPECT(told_at_ns - begin_ns < 150000000);
}

CASE(nobody_waits_for_what_is_beside_a_stream) {
  int both[2];
  char bytes[4];
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, both), 0);
  EXPECT_FAILS(recv(both[0], bytes, 4, MSG_OOB), EINVAL);
  int other = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_FAILS(recv(other, bytes, 4, MSG_ERRQUEUE), EAGAIN);
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
