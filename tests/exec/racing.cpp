// SPDX-License-Identifier: BSD-3-Clause
//
// Two threads count: with "locked" under one lock, with "ordered" by atomics, otherwise without synchronisation. With
// "flag", a thread reads a plain flag.
#include <atomic>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <thread>

namespace {

int seen = 0;
bool ready = false;
std::atomic<int> turn{0};
std::mutex mutex;

void count() {
  const int before = seen;
  seen = before + 1;
}

void count_locked() {
  const std::lock_guard guard(mutex);
  count();
}

void count_at(int mine) {
  while (turn.load() != mine) std::this_thread::yield();
  count();
  turn.store(mine + 1);
}

}  // namespace

int main(int argc, char** argv) {
  const char* const way = argc > 1 ? argv[1] : "";
  std::thread first, second;
  if (std::strcmp(way, "locked") == 0) {
    first = std::thread(count_locked);
    second = std::thread(count_locked);
  } else if (std::strcmp(way, "ordered") == 0) {
    first = std::thread(count_at, 0);
    second = std::thread(count_at, 1);
  } else if (std::strcmp(way, "flag") == 0) {
    first = std::thread([] {
      seen = 2;
      ready = true;
    });
    second = std::thread([] {
      if (ready && seen != 2) std::puts("ready, but nothing seen");
    });
  } else {
    first = std::thread(count);
    second = std::thread(count);
  }
  first.join();
  second.join();
  std::printf("%d seen\n", seen);
  return seen == 2 ? 0 : 1;
}
