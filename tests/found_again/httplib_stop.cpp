// SPDX-License-Identifier: BSD-3-Clause
// cpp-httplib, issue 1371: a server is stopped while its thread starts.
#include <httplib.h>

#include <thread>

int main() {
  httplib::Server server;
  server.bind_to_any_port("127.0.0.1");
  std::thread listener([&] { server.listen_after_bind(); });
  server.stop();
  listener.join();
}
