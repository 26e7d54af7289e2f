// SPDX-License-Identifier: BSD-3-Clause
// As much of a broker for MQTT as a connection needs: it accepts a client, and answers the client's first message.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>

/// A socket that listens at `port` of this machine.
inline int listen_at(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  listen(listener, 1);
  return listener;
}

/// Accepts a connection, which is left open.
inline void accept_client(int listener) {
  const unsigned char accepted[] = {0x20, 2, 0, 0};
  unsigned char request[64];
  const int client = accept(listener, nullptr, nullptr);
  if (read(client, request, sizeof request) > 0) write(client, accepted, sizeof accepted);
}
