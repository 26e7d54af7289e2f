// SPDX-License-Identifier: BSD-3-Clause
// Poco (docs/found.md): two threads stop a timer.
#include <Poco/Timer.h>

#include <thread>

class Worker {
 public:
  void tick(Poco::Timer& /*timer*/) {}
};

int main() {
  Worker worker;
  Poco::Timer timer(0, 10);
  timer.start(Poco::TimerCallback<Worker>(worker, &Worker::tick));
  std::thread other([&] { timer.stop(); });
  timer.stop();
  other.join();
}
