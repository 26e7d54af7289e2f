// SPDX-License-Identifier: BSD-3-Clause
// Orocos RTT (docs/found.md): a timer is armed again when it has just expired.
#include <rtt/os/startstop.h>
#include <unistd.h>
#include <rtt/os/Timer.hpp>

#include <atomic>
#include <cstdio>
#include <cstdlib>

class Counting : public RTT::os::Timer {
 public:
  Counting() : Timer(1, ORO_SCHED_OTHER, 0) {}
  void timeout(TimerId /*id*/) override { ++timeouts; }

  std::atomic<int> timeouts = 0;
};

int main(int argc, char** argv) {
  __os_init(argc, argv);
  bool lost = false;
  {
    Counting timer;
    timer.arm(0, 1);
    sleep(1);
    timer.arm(0, 2);
    const int before = timer.timeouts;
    sleep(3);
    lost = timer.timeouts == before;
  }
  __os_exit();
  if (!lost) return 0;
  std::fprintf(stderr, "the armed timer did not expire\n");
  return EXIT_FAILURE;
}
