// SPDX-License-Identifier: BSD-3-Clause
//
// streams send PORT: sends five records with the time, one each 100 ms, in different ways; then a million bytes and the
// end.
// streams receive PORT: prints the delay of each record and of the end; reads slowly, and checks the bytes.
// streams leave PORT: asks, waits for the answer, prints its delay, writes once more, and ends at once.
// streams meet PORT: answers, and prints the delays of the question, the last message and the end.
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

enum { records = 5, bulk = 1000000 };

struct record {
  long long number, sent_ns;
};

static long long now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec;
}

static void say_late(const char* what, long long number, long long sent_ns) {
  printf("%s %lld after %lld ms\n", what, number, (now_ns() - sent_ns) / 1000000);
  fflush(stdout);
}

static int receive(const struct sockaddr_in* address) {
  const int listening = socket(AF_INET, SOCK_STREAM, 0);
  if (bind(listening, (const struct sockaddr*)address, sizeof *address) != 0 || listen(listening, 1) != 0) return 1;
  const int stream = accept(listening, NULL, NULL);
  struct record record;
  for (int i = 0; i < records; ++i) {
    if (recv(stream, &record, sizeof record, MSG_WAITALL) != sizeof record) return 1;
    say_late("record", record.number, record.sent_ns);
  }
  static unsigned char bytes[bulk];
  size_t size = 0;
  for (ssize_t got = 1; size < bulk && got > 0; size += (size_t)got) {
    got = read(stream, bytes + size, bulk - size < 50000 ? bulk - size : 50000);
    usleep(1000);
  }
  for (size_t i = 0; i < bulk; ++i)
    if (bytes[i] != (unsigned char)(i * 7 + i / 1000)) return 1;
  printf("bulk of %zu bytes\n", size);
  if (recv(stream, &record, sizeof record, MSG_WAITALL) != sizeof record) return 1;
  if (read(stream, bytes, 1) != 0) return 1;
  say_late("end", record.number, record.sent_ns);
  return 0;
}

static int send_all(const struct sockaddr_in* address) {
  const int stream = socket(AF_INET, SOCK_STREAM, 0);
  while (connect(stream, (const struct sockaddr*)address, sizeof *address) != 0) usleep(1000);
  struct record record = {0, 0};
  for (; record.number < records; ++record.number) {
    usleep(100000);
    record.sent_ns = now_ns();
    struct iovec parts[] = {{&record, 8}, {(char*)&record + 8, sizeof record - 8}};
    const struct msghdr message = {.msg_iov = parts, .msg_iovlen = 2};
    if (record.number % 3 == 0) send(stream, &record, sizeof record, 0);
    if (record.number % 3 == 1) writev(stream, parts, 2);
    if (record.number % 3 == 2) sendmsg(stream, &message, 0);
  }
  static unsigned char bytes[bulk];
  for (size_t i = 0; i < bulk; ++i) bytes[i] = (unsigned char)(i * 7 + i / 1000);
  if (write(stream, bytes, bulk) != bulk) return 1;
  usleep(200000);
  record.sent_ns = now_ns();
  write(stream, &record, sizeof record);
  shutdown(stream, SHUT_WR);
  char byte;
  while (read(stream, &byte, 1) > 0) {
  }
  return 0;
}

static int meet(const struct sockaddr_in* address) {
  const int listening = socket(AF_INET, SOCK_STREAM, 0);
  if (bind(listening, (const struct sockaddr*)address, sizeof *address) != 0 || listen(listening, 1) != 0) return 1;
  const int stream = accept(listening, NULL, NULL);
  struct record record;
  if (read(stream, &record, sizeof record) != sizeof record) return 1;
  say_late("record", record.number, record.sent_ns);
  record = (struct record){1, now_ns()};
  if (write(stream, &record, sizeof record) != sizeof record) return 1;
  if (read(stream, &record, sizeof record) != sizeof record) return 1;
  say_late("record", record.number, record.sent_ns);
  if (read(stream, &record, sizeof record) != 0) return 1;
  say_late("end", record.number, record.sent_ns);
  return 0;
}

static int leave(const struct sockaddr_in* address) {
  const int stream = socket(AF_INET, SOCK_STREAM, 0);
  while (connect(stream, (const struct sockaddr*)address, sizeof *address) != 0) usleep(1000);
  struct record record = {0, now_ns()};
  if (write(stream, &record, sizeof record) != sizeof record) return 1;
  if (read(stream, &record, sizeof record) != sizeof record) return 1;
  say_late("record", record.number, record.sent_ns);
  record = (struct record){2, now_ns()};
  return write(stream, &record, sizeof record) == sizeof record ? 0 : 1;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((unsigned short)atoi(argv[2]))};
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (strcmp(argv[1], "meet") == 0) return meet(&address);
  if (strcmp(argv[1], "leave") == 0) return leave(&address);
  return strcmp(argv[1], "receive") == 0 ? receive(&address) : send_all(&address);
}
