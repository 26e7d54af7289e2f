// SPDX-License-Identifier: BSD-3-Clause
//
// instance NUMBER [WAY]: counts to 3 in its own variables, of every storage kind, with two threads; prints NUMBER and
// the counts. Then ends in the given way.
#include <pthread.h>
#include <unistd.h>

#include <cassert>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>

int counter = 0;             // exported
inline int one_for_all = 0;  // the compiler marks it unique per process
static int* in_order = nullptr;
const char* error = "mine";  // the C library has a function with this name

struct Made {
  Made() : at(new int(0)) { in_order = at; }
  ~Made() {
    std::printf("%s: destroyed at %d\n", name.c_str(), *at);
    delete at;
  }
  int* at;
  std::string name;
};
Made made;

template <class T>
struct Kept {
  static int value;
};
template <class T>
int Kept<T>::value = 0;

thread_local int of_this_thread = 0;

static int counted() {
  static std::mutex mutex;
  static int times = 0;
  const std::lock_guard<std::mutex> lock(mutex);
  ++counter;
  ++one_for_all;
  ++Kept<int>::value;
  ++*in_order;
  ++of_this_thread;
  return ++times;
}

int main(int argc, char** argv) {
  if (argc < 2 || std::strcmp(error, "mine") != 0) return 2;
  made.name = argv[1];
  counted();
  std::thread other([] {
    usleep(1000);
    counted();
  });
  other.join();
  const int times = counted();
  std::printf("%s: %d %d %d %d %d, %d\n", argv[1], counter, one_for_all, Kept<int>::value, *in_order, times,
              of_this_thread);
  const std::string way = argc > 2 ? argv[2] : "";
  // It ends with the program.
  std::thread sleeper([] {
    for (;;) sleep(1000);
  });
  const pthread_t asleep = sleeper.native_handle();
  sleeper.detach();
  if (way == "exit") std::thread([] { std::exit(3); }).join();
  if (way == "_exit") std::thread([] { _exit(4); }).join();
  if (way == "abort") std::abort();
  if (way == "assert") assert(times == 0);
  if (way == "crash") raise(SIGSEGV);
  if (way == "throw") throw 1;
  if (way == "main leaves") {
    std::thread([] { usleep(5000); }).detach();
    pthread_cancel(asleep);
    pthread_exit(nullptr);
  }
  if (way == "deadlock") {
    std::mutex mutex;
    mutex.lock();
    mutex.lock();
  }
  return std::atoi(way.c_str());
}
