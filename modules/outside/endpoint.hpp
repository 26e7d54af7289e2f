// SPDX-License-Identifier: BSD-3-Clause
// Where the simulation meets processes outside: unix:PATH, a local socket, or tcp:PORT, a port of the loopback only.
#pragma once

#include <cstdint>
#include <string>

#include "modules/outside/descriptor.hpp"

namespace waitpoint::outside {

struct Endpoint {
  std::string path;        ///< of a local socket; empty: TCP
  std::uint16_t port = 0;  ///< 0, to listen: any free one

  /// "unix:robot.socket", "tcp:7000".
  std::string text() const;
};

/// Throws BadInput at `where` for another text.
Endpoint parse_endpoint(const std::string& text, const std::string& where);

class Listener {
 public:
  /// Throws BadInput at `where` if the endpoint cannot be had. A socket file that no process listens at any more is
  /// replaced.
  Listener(const Endpoint& endpoint, const std::string& where);
  /// Removes the socket file.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// With the port that was given for 0.
  const Endpoint& endpoint() const { return endpoint_; }
  /// The next connection that waits, not blocking; none if there is none.
  Descriptor accept();

 private:
  Endpoint endpoint_;
  Descriptor socket_;
};

/// A blocking connection. Throws BadInput at `where` if it is refused.
Descriptor connect_to(const Endpoint& endpoint, const std::string& where);

}  // namespace waitpoint::outside
