// SPDX-License-Identifier: BSD-3-Clause
// Poco (docs/found.md): a pool of threads is destroyed after it has started a runnable.
#include <Poco/Runnable.h>
#include <Poco/ThreadPool.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

class Counting : public Poco::Runnable {
 public:
  void run() override { ++runs; }

  std::atomic<int> runs = 0;
};

int main() {
  Counting runnable;
  {
    Poco::ThreadPool pool;
    pool.start(runnable);
  }
  if (runnable.runs == 1) return 0;
  std::fprintf(stderr, "the runnable did not run\n");
  return EXIT_FAILURE;
}
