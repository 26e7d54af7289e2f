// SPDX-License-Identifier: BSD-3-Clause
// Poco, issue 4970: an observer is removed by the thread that handles its notification, and by another thread.
#include <Poco/NObserver.h>
#include <Poco/Notification.h>
#include <Poco/NotificationCenter.h>

#include <thread>

namespace {

class Target {
 public:
  void watch() { center_.addObserver(observer()); }
  void stop() { center_.removeObserver(observer()); }
  void notify() { center_.postNotification(new Poco::Notification); }

 private:
  Poco::NObserver<Target, Poco::Notification> observer() { return {*this, &Target::handle}; }
  void handle(const Poco::AutoPtr<Poco::Notification>&) { stop(); }

  Poco::NotificationCenter center_;
};

}  // namespace

int main() {
  Target target;
  target.watch();
  std::thread source([&] { target.notify(); });
  target.stop();
  source.join();
}
