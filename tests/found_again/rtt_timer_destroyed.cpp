// SPDX-License-Identifier: BSD-3-Clause
// Orocos RTT (docs/found.md): a timer is destroyed while its thread looks for the next one to expire.
#include <rtt/os/startstop.h>
#include <rtt/os/Timer.hpp>

int main(int argc, char** argv) {
  __os_init(argc, argv);
  {
    RTT::os::Timer timer(1, ORO_SCHED_OTHER, 0);
    timer.killTimer(0);
  }
  __os_exit();
}
