// SPDX-License-Identifier: BSD-3-Clause
// OpenThreads (docs/found.md): two threads read under a lock of many readers.
#include <OpenThreads/ReadWriteMutex>
#include <thread>

int main() {
  OpenThreads::ReadWriteMutex mutex;
  const auto read = [&] { const OpenThreads::ScopedReadLock lock(mutex); };
  std::thread one(read);
  std::thread two(read);
  one.join();
  two.join();
}
