// SPDX-License-Identifier: BSD-3-Clause
// Poco, pull request 2542: a message is logged while the file is closed.
#include <Poco/AutoPtr.h>
#include <Poco/FileChannel.h>
#include <Poco/Message.h>

#include <thread>

int main() {
  Poco::AutoPtr<Poco::FileChannel> channel(new Poco::FileChannel("/dev/null"));
  channel->open();
  std::thread source([&] { channel->log(Poco::Message("source", "text", Poco::Message::PRIO_INFORMATION)); });
  channel->close();
  source.join();
}
