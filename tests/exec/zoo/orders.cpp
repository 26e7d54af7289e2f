// SPDX-License-Identifier: BSD-3-Clause
// Events assumed to occur in one order, among 2 to 100 threads.
#include <atomic>
#include <latch>
#include <mutex>

#include "tests/exec/zoo/crew.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/orders.hpp"

namespace waitpoint::zoo {
namespace {

// Robots that open a door and then announce it; a supervisor sees an open door that no robot has announced: it checks
// after one has opened it and before one has announced it. None begins before all are created.
template <bool mended>
void reorder(int threads) {
  std::mutex beginning, both;
  std::atomic<int> open = 0, said = 0;
  const auto begin = [&] { const std::lock_guard guard(beginning); };
  beginning.lock();
  Crew crew;
  for (int i = 0; i < threads - 1; ++i)
    crew.add([&] {
      begin();
      std::unique_lock guard(both, std::defer_lock);
      if (mended) guard.lock();
      open.store(1);
      said.store(1);
    });
  crew.add([&] {
    begin();
    std::unique_lock guard(both, std::defer_lock);
    if (mended) guard.lock();
    const bool is_open = open.load() == 1;
    check(!is_open || said.load() == 1, "a door stands open that nobody told of");
  });
  beginning.unlock();
  crew.join();
}

// The first thread creates the table that the last one uses after reading its parameters: usually there is time enough.
template <bool mended>
void last_before_first(int threads) {
  constexpr int parameters = 8;
  std::mutex lock;
  int read = 0;
  bool is_made = false;
  std::latch made(1);
  const auto look = [&] {
    const std::lock_guard guard(lock);
    return is_made;
  };
  Crew crew;
  crew.add([&] {
    const std::lock_guard guard(lock);
    is_made = true;
    made.count_down();
  });
  for (int i = 0; i < threads - 2; ++i) crew.add([&] { look(); });
  crew.add([&] {
    for (int i = 0; i < parameters; ++i) {
      const std::lock_guard guard(lock);
      ++read;
    }
    if (mended) made.wait();
    check(look(), "used before it is made");
  });
  crew.join();
}

// A convoy whose rearguard is assumed to report after the others, as it was sent after them. None reports before all
// are created.
template <bool mended>
void convoy(int threads) {
  std::mutex lock;
  int reported = 0;
  std::latch passed(threads - 1);
  const auto report = [&] {
    const std::lock_guard guard(lock);
    return ++reported;
  };
  lock.lock();
  Crew crew;
  for (int i = 0; i < threads - 1; ++i)
    crew.add([&] {
      report();
      passed.count_down();
    });
  crew.add([&] {
    if (mended) passed.wait();
    check(report() > 1, "the rearguard comes first");
  });
  lock.unlock();
  crew.join();
}

}  // namespace
}  // namespace waitpoint::zoo

using namespace waitpoint::zoo;

const specimen orders[] = {
    {"reorder 3", MEMORY, 3, either<reorder<false>, reorder<true>>},
    {"reorder 5", MEMORY, 5, either<reorder<false>, reorder<true>>},
    {"reorder 10", MEMORY, 10, either<reorder<false>, reorder<true>>},
    {"reorder 20", MEMORY, 20, either<reorder<false>, reorder<true>>},
    {"reorder 50", MEMORY, 50, either<reorder<false>, reorder<true>>},
    {"reorder 100", MEMORY, 100, either<reorder<false>, reorder<true>>},
    {"last before first of 20", SYNCHRONIZATION, 20, either<last_before_first<false>, last_before_first<true>>},
    {"last before first of 100", SYNCHRONIZATION, 100, either<last_before_first<false>, last_before_first<true>>},
    {"convoy of 50", SYNCHRONIZATION, 50, either<convoy<false>, convoy<true>>},
    {"convoy of 100", SYNCHRONIZATION, 100, either<convoy<false>, convoy<true>>},
    {"late subscriber", SYNCHRONIZATION, 2, either<late_subscriber<false>, late_subscriber<true>>},
    {"half the route", SYNCHRONIZATION, 2, either<half_the_route<false, 10>, half_the_route<true, 10>>},
    {},
};
