// SPDX-License-Identifier: BSD-3-Clause
//
// Sums with TBB tasks, in an arena of four threads.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdio>
#include <thread>

int main() {
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena arena(4);
  tbb::enumerable_thread_specific<long> sums(0);
  for (int round = 0; round < 300; ++round)
    arena.execute([&] {
      tbb::parallel_for(0, 64, 1, [&](int i) {
        std::this_thread::sleep_for(std::chrono::microseconds(10));
        sums.local() += i;
      });
    });
  std::printf("%ld\n", sums.combine([](long a, long b) { return a + b; }));
}
