// SPDX-License-Identifier: BSD-3-Clause
// A notification is lost in one order of the threads: exploration finds it, and its token is stepped through in gdb.
#include <iostream>
#include <mutex>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

namespace threads = waitpoint::threads;

namespace {

void lose_a_letter() {
  threads::mutex door("door");
  threads::condition_variable bell("bell");
  threads::thread reader({.name = "reader"}, [&] {
    std::unique_lock lock(door);
    bell.wait(lock);  // without a predicate: an earlier notification is lost
  });
  threads::thread postman({.name = "postman"}, [&] { bell.notify_one(); });
  postman.join();
  reader.join();
}

}  // namespace

int main() {
  const waitpoint::ExploreReport report = waitpoint::explore(lose_a_letter);
  std::cout << report << "\n";
  return report.passed ? 0 : 1;
}
