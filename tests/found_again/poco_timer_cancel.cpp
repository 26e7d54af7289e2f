// SPDX-License-Identifier: BSD-3-Clause
// Poco, issue 3921: a timer is cancelled, and cancelled again by a call that waits until that is done.
#include <Poco/Util/Timer.h>

int main() {
  Poco::Util::Timer timer;
  timer.cancel();
  timer.cancel(true);
}
