// SPDX-License-Identifier: BSD-3-Clause
// Poco, issue 3986: a timer is cancelled and destroyed.
#include <Poco/Util/Timer.h>

int main() {
  Poco::Util::Timer timer;
  timer.cancel();
}
