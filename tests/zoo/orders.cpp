// SPDX-License-Identifier: BSD-3-Clause
// Events assumed to occur in one order, among 3 to 100 threads.
#include <mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/latch.hpp"
#include "fibers/sync/mutex.hpp"
#include "tests/zoo/zoo.hpp"

// Needs the primitives declared above.
#include "tests/zoo/shared/orders.hpp"

namespace waitpoint::zoo {
namespace {

// Robots that open a door and then announce it; a supervisor sees an open door that no robot has announced: it checks
// after one has opened it and before one has announced it.
template <bool mended, int robots>
void reorder() {
  mutex both;
  atomic<int> open(0), said(0);
  Crew crew;
  for (int i = 0; i < robots - 1; ++i)
    crew.add("robot", [&] {
      std::unique_lock guard(both, std::defer_lock);
      if (mended) guard.lock();
      open.store(1);
      said.store(1);
    });
  crew.add("supervisor", [&] {
    std::unique_lock guard(both, std::defer_lock);
    if (mended) guard.lock();
    const bool is_open = open.load() == 1;
    check(!is_open || said.load() == 1, "a door stands open that nobody told of");
  });
  crew.join();
}

// The first thread creates the table that the last one uses after reading its parameters: usually there is time enough.
template <bool mended, int threads>
void last_before_first() {
  constexpr int parameters = 12;
  atomic<int> table(0), parameter(0);
  latch made(1);
  Crew crew;
  crew.add("maker", [&] {
    table.store(1);
    made.count_down();
  });
  for (int i = 0; i < threads - 2; ++i) crew.add("other", [table = &table] { (void)table->load(); });
  crew.add("user", [&] {
    for (int i = 0; i < parameters; ++i) parameter.fetch_add(1);
    if (mended) made.wait();
    check(table.load() == 1, "used before it is made");
  });
  crew.join();
}

// A convoy whose rearguard is assumed to report after the others, as it was sent after them.
template <bool mended, int robots>
void convoy() {
  atomic<int> reported(0);
  latch passed(robots - 1);
  Crew crew;
  for (int i = 0; i < robots - 1; ++i)
    crew.add("follower", [&] {
      reported.fetch_add(1);
      passed.count_down();
    });
  crew.add("rearguard", [&] {
    if (mended) passed.wait();
    check(reported.fetch_add(1) > 0, "the rearguard comes first");
  });
  crew.join();
}

}  // namespace

Specimens orders() {
  return {{"reorder 3", reorder<false, 3>, reorder<true, 3>, 1, "order"},
          {"reorder 5", reorder<false, 5>, reorder<true, 5>, 1, "order"},
          {"reorder 10", reorder<false, 10>, reorder<true, 10>, 1, "order"},
          {"reorder 20", reorder<false, 20>, reorder<true, 20>, 1, "order"},
          {"reorder 50", reorder<false, 50>, reorder<true, 50>, 1, "order"},
          {"reorder 100", reorder<false, 100>, reorder<true, 100>, 1, "order"},
          {"last before first of 20", last_before_first<false, 20>, last_before_first<true, 20>, 1, "order"},
          {"last before first of 100", last_before_first<false, 100>, last_before_first<true, 100>, 1, "order"},
          {"convoy of 50", convoy<false, 50>, convoy<true, 50>, 1, "order"},
          {"convoy of 100", convoy<false, 100>, convoy<true, 100>, 1, "order"},
          {"late subscriber", late_subscriber<false>, late_subscriber<true>, 1, "order"},
          {"half the route", half_the_route<false, 14>, half_the_route<true, 14>, 2, "order"}};
}

}  // namespace waitpoint::zoo
