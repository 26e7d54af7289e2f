// SPDX-License-Identifier: BSD-3-Clause
// Ignition Common (docs/found.md): a thread waits for the results of a pool's work.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <ignition/common/WorkerPool.hh>

int main() {
  ignition::common::WorkerPool pool;
  std::atomic<bool> done = false;
  pool.AddWork([&] { done = true; });
  if (!pool.WaitForResults() || done) return 0;
  std::fprintf(stderr, "WaitForResults() returned before the work was done\n");
  std::_Exit(EXIT_FAILURE);
}
