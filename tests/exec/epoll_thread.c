// SPDX-License-Identifier: BSD-3-Clause
//
// A thread that handles a connection over the loopback, as in a library, and a main thread that waits for what it
// receives. It notes the reception without the lock: the main thread may miss it, and wait for ever. With "native wait",
// whoever comes second waits where the simulation cannot see it.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <pthread.h>
#include <stdint.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t received = PTHREAD_COND_INITIALIZER;
static int has_received, listening, ends[2], wake;

static void watch(int epoll, int descriptor) {
  struct epoll_event event = {.events = EPOLLIN, .data = {.fd = descriptor}};
  epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event);
}

static void* handle(void* of) {
  const int epoll = epoll_create1(0);
  watch(epoll, listening);
  watch(epoll, ends[1]);
  watch(epoll, wake);
  for (;;) {
    struct epoll_event event;
    char bytes[8];
    if (epoll_wait(epoll, &event, 1, -1) != 1) continue;
    if (read(event.data.fd, bytes, sizeof bytes) <= 0 || event.data.fd == wake) return of;
    has_received = 1;
    pthread_cond_signal(&received);
  }
}

static void connect_to_itself(void) {
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
  socklen_t size = sizeof address;
  listening = socket(AF_INET, SOCK_STREAM, 0);
  bind(listening, (struct sockaddr*)&address, size);
  listen(listening, 5);
  getsockname(listening, (struct sockaddr*)&address, &size);
  ends[0] = socket(AF_INET, SOCK_STREAM, 0);
  connect(ends[0], (struct sockaddr*)&address, size);
  ends[1] = accept(listening, NULL, NULL);
}

static void* come_first(void* of) {
  has_received = 1;
  return of;
}

int main(int count, char** words) {
  pthread_t thread;
  if (count > 1 && strcmp(words[1], "native wait") == 0) {
    pthread_create(&thread, NULL, come_first, NULL);
    mkfifo(words[2], 0600);
    if (has_received) open(words[2], O_RDONLY);
    return 0;
  }
  connect_to_itself();
  wake = eventfd(0, 0);
  pthread_create(&thread, NULL, handle, NULL);
  if (write(ends[0], "x", 1) != 1) return 2;
  pthread_mutex_lock(&mutex);
  while (!has_received) pthread_cond_wait(&received, &mutex);
  pthread_mutex_unlock(&mutex);
  const uint64_t one = 1;
  if (write(wake, &one, sizeof one) != sizeof one) return 2;
  pthread_join(thread, NULL);
  return 0;
}
