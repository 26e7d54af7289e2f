// SPDX-License-Identifier: BSD-3-Clause
// Poco, issue 1039: a message is logged while its channel is closed.
#include <Poco/AsyncChannel.h>
#include <Poco/AutoPtr.h>
#include <Poco/Message.h>
#include <Poco/StreamChannel.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

int main() {
  std::ostringstream logged;
  Poco::AutoPtr<Poco::AsyncChannel> channel(new Poco::AsyncChannel(new Poco::StreamChannel(logged)));
  channel->open();
  std::thread source([&] { channel->log(Poco::Message("source", "text", Poco::Message::PRIO_INFORMATION)); });
  channel->close();
  source.join();
  channel->close();
  if (!logged.str().empty()) return 0;
  std::fprintf(stderr, "the message was not logged\n");
  return EXIT_FAILURE;
}
