// SPDX-License-Identifier: BSD-3-Clause
// Sockets with addresses: internet, loopback, and local ones.
#include "tests/exec/conformance/sockets.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/un.h>

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
static void connect_both(int listening) {
  ends[1] = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_IS(connect(ends[1], (struct sockaddr*)&address, sizeof address), 0);
  ends[0] = accept(listening, NULL, NULL);
  EXPECT(ends[0] >= 0);
}
CASE(small_pieces_come_one_after_the_other) {
  connect_both(listen_on(SOCK_STREAM));
  for (int i = 0; i < 5; ++i) {
    EXPECT_IS(write(ends[1], "a", 1), 1);
    EXPECT_IS(write(ends[1], "b", 1), 1);
    for (int j = 0; j < 2; ++j) {
      char byte = 0;
      EXPECT_IS(poll(&(struct pollfd){ends[0], POLLIN, 0}, 1, 1000), 1);
      EXPECT_IS(read(ends[0], &byte, 1), 1);
      EXPECT_IS(byte, "ab"[j]);
    }
  }
}
static int has_no_delay(int descriptor) {
  int value = -1;
  socklen_t size = sizeof value;
  EXPECT_IS(getsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &value, &size), 0);
  return value;
}
CASE(whether_pieces_are_delayed_is_as_was_asked_for) {
  const int listening = listen_on(SOCK_STREAM), on = 1, off = 0;
  connect_both(listening);
  EXPECT_IS(has_no_delay(ends[0]), 0);
  EXPECT_IS(has_no_delay(ends[1]), 0);
  EXPECT_IS(setsockopt(listening, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on), 0);
  EXPECT_IS(setsockopt(ends[1], IPPROTO_TCP, TCP_NODELAY, &on, sizeof on), 0);
  EXPECT_IS(has_no_delay(dup(ends[1])), 1);
  EXPECT_IS(setsockopt(ends[1], IPPROTO_TCP, TCP_NODELAY, &off, sizeof off), 0);
  EXPECT_IS(has_no_delay(ends[1]), 0);
  connect_both(listening);
  EXPECT_IS(has_no_delay(ends[0]), 1);
  EXPECT_FAILS(setsockopt(ends[1], IPPROTO_TCP, TCP_NODELAY, &on, 1), EINVAL);
  EXPECT_FAILS(setsockopt(ends[1], IPPROTO_TCP, TCP_NODELAY, NULL, sizeof on), EFAULT);
  EXPECT_FAILS(setsockopt(socket(AF_UNIX, SOCK_STREAM, 0), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on), EOPNOTSUPP);
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
