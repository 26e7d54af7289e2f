// SPDX-License-Identifier: BSD-3-Clause
//
// Two threads with harmless data races in each order, and a failure in few of them, if they lose an update: "abort" or
// "crash" in the first argument. With "-or-deadlock" in it, they also lock two mutexes in opposite orders.
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

namespace {

int begun = 0, done = 0;
std::atomic<int> value{0};
std::mutex left, right;
const char* way = "";

void lock_both(std::mutex& first, std::mutex& second) {
  const std::lock_guard outer(first);
  const std::lock_guard inner(second);
}

void increment(std::mutex& first, std::mutex& second) {
  begun = 1;
  const int read = value.load();
  value.store(read + 1);
  if (std::strstr(way, "-or-deadlock") != nullptr) lock_both(first, second);
  done = 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) way = argv[1];
  std::thread one([] { increment(left, right); }), two([] { increment(right, left); });
  one.join();
  two.join();
  if (begun + done != 2) return 3;
  if (value.load() == 2) return 0;
  if (std::strstr(way, "crash") != nullptr) *static_cast<volatile int*>(nullptr) = 1;
  if (std::strstr(way, "abort") != nullptr) std::abort();
  return 0;
}
