// SPDX-License-Identifier: BSD-3-Clause
// Boost.Thread, issue 373: a thread that waits to lock a shared mutex is interrupted.
#define BOOST_THREAD_V2_SHARED_MUTEX
#include <boost/thread.hpp>

int main() {
  boost::shared_mutex mutex;
  mutex.lock_shared();
  boost::thread writer([&] { boost::unique_lock<boost::shared_mutex> lock(mutex); });
  writer.interrupt();
  mutex.unlock_shared();
  writer.join();
  mutex.lock_shared();
  mutex.unlock_shared();
}
