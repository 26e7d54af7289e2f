// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/faulty_bodies.hpp"

#include <mutex>
#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::faulty {

void count_to_three(int least) {
  atomic<int> count{0};
  std::vector<thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      const int seen = count.load();
      count.store(seen + 1);
    });
  for (thread& t : threads) t.join();
  check(count.load() >= least, "an increment was lost");
}

void lose_a_wake_up() {
  mutex m;
  condition_variable arrived;
  bool there = false;
  thread consumer({.name = "consumer"}, [&] {
    {
      const std::lock_guard guard(m);
      if (there) return;
    }
    std::unique_lock lock(m);
    arrived.wait(lock);
  });
  thread producer({.name = "producer"}, [&] {
    const std::lock_guard guard(m);
    there = true;
    arrived.notify_one();
  });
  consumer.join();
  producer.join();
}

}  // namespace waitpoint::faulty
