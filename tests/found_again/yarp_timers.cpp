// SPDX-License-Identifier: BSD-3-Clause
// YARP (docs/found.md): two threads make and destroy a timer each.
#include <yarp/os/Network.h>
#include <yarp/os/Timer.h>

#include <thread>

static void use_a_timer() {
  const auto tick = [](const yarp::os::YarpTimerEvent&) { return true; };
  yarp::os::Timer timer(yarp::os::TimerSettings(0.01), tick, false);
  timer.start();
  timer.stop();
}

int main() {
  yarp::os::NetworkBase::setLocalMode(true);
  yarp::os::NetworkBase::initMinimum(yarp::os::YARP_CLOCK_SYSTEM);
  std::thread other(use_a_timer);
  use_a_timer();
  other.join();
}
