// SPDX-License-Identifier: BSD-3-Clause
//
// Two processes, or two threads, exchange bytes or turns; starts of processes.
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <semaphore.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>

#include "tests/bench/exec/workloads.hpp"

extern char** environ;

namespace waitpoint::bench {
namespace {

void wait_for(pid_t process) {
  int status = 0;
  require(waitpid(process, &status, 0) == process && status == 0, "waitpid");
}

// One runs in a child.
void in_two_processes(const std::function<void()>& one, const std::function<void()>& other) {
  const pid_t child = fork();
  require(child >= 0, "fork");
  if (child == 0) {
    one();
    _exit(0);
  }
  other();
  wait_for(child);
}

void in_two_threads(const std::function<void()>& one, const std::function<void()>& other) {
  pthread_t thread;
  const auto run = [](void* body) -> void* {
    (*static_cast<const std::function<void()>*>(body))();
    return nullptr;
  };
  require(pthread_create(&thread, nullptr, run, const_cast<std::function<void()>*>(&one)) == 0, "pthread_create");
  other();
  pthread_join(thread, nullptr);
}

void send(int descriptor) {
  const char byte = 1;
  require(write(descriptor, &byte, 1) == 1, "write");
}
void receive(int descriptor) {
  char byte = 0;
  require(read(descriptor, &byte, 1) == 1, "read");
}

// A byte goes to and fro.
std::function<void()> first_of(long rounds, int to, int from) {
  return [=] {
    for (long i = 0; i < rounds; ++i) {
      send(to);
      receive(from);
    }
  };
}
std::function<void()> second_of(long rounds, int to, int from) {
  return [=] {
    for (long i = 0; i < rounds; ++i) {
      receive(from);
      send(to);
    }
  };
}

using Ends = std::array<int, 2>;

Ends new_pipe() {
  Ends ends{};
  require(pipe(ends.data()) == 0, "pipe");
  return ends;
}

Ends connected_over_loopback() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0), connected = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  require(bind(listener, any, size) == 0 && listen(listener, 1) == 0, "listen");
  require(getsockname(listener, any, &size) == 0 && connect(connected, any, size) == 0, "connect");
  const Ends ends = {connected, accept(listener, nullptr, nullptr)};
  require(ends[1] >= 0, "accept");
  const int at_once = 1;
  for (const int end : ends) setsockopt(end, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
  close(listener);
  return ends;
}

}  // namespace

void require(bool succeeded, const char* call) {
  if (succeeded) return;
  std::perror(call);
  std::_Exit(1);
}

void hand_over_by_semaphores(long count) {
  void* const memory = mmap(nullptr, 2 * sizeof(sem_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  require(memory != MAP_FAILED, "mmap");
  auto* const semaphores = new (memory) sem_t[2];
  for (int i = 0; i < 2; ++i) sem_init(&semaphores[i], 1, 0);
  const auto take_turns = [=](int own) {
    for (long i = 0; i < count / 2; ++i) {
      if (own == 1) sem_wait(&semaphores[own]);
      sem_post(&semaphores[1 - own]);
      if (own == 0) sem_wait(&semaphores[own]);
    }
  };
  in_two_processes([&] { take_turns(1); }, [&] { take_turns(0); });
}

void hand_over_by_pipes(long count) {
  const Ends there = new_pipe(), back = new_pipe();
  in_two_processes(second_of(count / 2, back[1], there[0]), first_of(count / 2, there[1], back[0]));
}

void hand_over_by_tcp(long count) {
  const Ends ends = connected_over_loopback();
  in_two_processes(second_of(count / 2, ends[1], ends[1]), first_of(count / 2, ends[0], ends[0]));
}

void write_and_read(long count) {
  const Ends ends = new_pipe();
  for (long i = 0; i < count; ++i) {
    send(ends[1]);
    receive(ends[0]);
  }
}

void hand_over_by_pipes_of_threads(long count) {
  const Ends there = new_pipe(), back = new_pipe();
  in_two_threads(second_of(count / 2, back[1], there[0]), first_of(count / 2, there[1], back[0]));
}

void hand_over_by_socket_pair(long count) {
  Ends ends{};
  require(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0, "socketpair");
  in_two_threads(second_of(count / 2, ends[1], ends[1]), first_of(count / 2, ends[0], ends[0]));
}

void fork_and_wait(long count) {
  for (long i = 0; i < count; ++i) in_two_processes([] {}, [] {});
}

void spawn_and_wait(long count) {
  char name[] = "true";
  char* const words[] = {name, nullptr};
  for (long i = 0; i < count; ++i) {
    pid_t child = 0;
    require(posix_spawn(&child, "/bin/true", nullptr, nullptr, words, environ) == 0, "posix_spawn");
    wait_for(child);
  }
}

}  // namespace waitpoint::bench
