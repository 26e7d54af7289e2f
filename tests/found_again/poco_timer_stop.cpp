// SPDX-License-Identifier: BSD-3-Clause
// Poco (docs/found.md): a timer is stopped while its callback sets the interval.
#include <Poco/Timer.h>

class Worker {
 public:
  void tick(Poco::Timer& timer) { timer.setPeriodicInterval(20); }
};

int main() {
  Worker worker;
  Poco::Timer timer(0, 10);
  timer.start(Poco::TimerCallback<Worker>(worker, &Worker::tick));
  timer.stop();
}
