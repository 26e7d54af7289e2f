// SPDX-License-Identifier: BSD-3-Clause
// OpenThreads (docs/found.md): a thread waits until another one releases the block.
#include <OpenThreads/Block>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

int main() {
  OpenThreads::Block block;
  std::atomic<bool> ready = false;
  std::thread other([&] {
    ready = true;
    block.release();
  });
  const bool released = block.block();
  const bool early = released && !ready;
  other.join();
  if (!early) return 0;
  std::fprintf(stderr, "block() returned before release()\n");
  return EXIT_FAILURE;
}
