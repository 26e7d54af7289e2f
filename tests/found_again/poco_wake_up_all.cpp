// SPDX-License-Identifier: BSD-3-Clause
// Poco, issue 5213: a worker that takes notifications from a queue is told to end, and woken.
#include <Poco/AutoPtr.h>
#include <Poco/NotificationQueue.h>

#include <atomic>
#include <thread>

int main() {
  Poco::NotificationQueue queue;
  std::atomic<bool> ends = false;
  std::thread worker([&] {
    while (!ends) const Poco::AutoPtr<Poco::Notification> notification(queue.waitDequeueNotification());
  });
  ends = true;
  queue.wakeUpAll();
  worker.join();
}
