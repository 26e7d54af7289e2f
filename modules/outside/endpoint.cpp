// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/endpoint.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::outside {
namespace {

constexpr std::string_view local = "unix:", internet = "tcp:";
constexpr int waiting_max = 8;

/// The address in the form of the system's calls.
class Address {
 public:
  explicit Address(const Endpoint& endpoint) {
    if (endpoint.path.empty()) {
      internet_.sin_family = AF_INET;
      internet_.sin_port = htons(endpoint.port);
      internet_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    } else {
      local_.sun_family = AF_UNIX;
      endpoint.path.copy(local_.sun_path, sizeof local_.sun_path - 1);
      is_local_ = true;
    }
  }

  const sockaddr* get() const {
    return is_local_ ? reinterpret_cast<const sockaddr*>(&local_) : reinterpret_cast<const sockaddr*>(&internet_);
  }
  socklen_t size() const { return is_local_ ? sizeof local_ : sizeof internet_; }

 private:
  sockaddr_un local_{};
  sockaddr_in internet_{};
  bool is_local_ = false;
};

Descriptor socket_for(const Endpoint& endpoint, int flags) {
  return Descriptor(socket(endpoint.path.empty() ? AF_INET : AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | flags, 0));
}

bool connects(const Descriptor& socket, const Address& address) {
  int result = -1;
  do {
    result = connect(socket.number(), address.get(), address.size());
  } while (result < 0 && errno == EINTR);
  return result == 0;
}

// Only a socket is: connecting to a file of another kind, which is the user's, is refused too.
bool is_left_behind(const Endpoint& endpoint, const Address& address) {
  struct stat found {};
  if (endpoint.path.empty() || lstat(endpoint.path.c_str(), &found) != 0 || !S_ISSOCK(found.st_mode)) return false;
  const Descriptor probe = socket_for(endpoint, 0);
  return !connects(probe, address) && errno == ECONNREFUSED;
}

// Lines are short and urgent.
void send_at_once(const Endpoint& endpoint, const Descriptor& socket) {
  const int on = 1;
  if (endpoint.path.empty()) setsockopt(socket.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

}  // namespace

std::string Endpoint::text() const {
  return path.empty() ? std::string(internet) + std::to_string(port) : std::string(local) + path;
}

Endpoint parse_endpoint(const std::string& text, const std::string& where) {
  Endpoint endpoint;
  if (text.starts_with(local)) {
    endpoint.path = text.substr(local.size());
    constexpr std::size_t path_max = sizeof sockaddr_un().sun_path - 1;
    if (!endpoint.path.empty() && endpoint.path.size() <= path_max) return endpoint;
    if (!endpoint.path.empty())
      throw BadInput(
          where, "expected a path of at most " + std::to_string(path_max) + " bytes, found '" + endpoint.path + "'");
  } else if (text.starts_with(internet) && parse_number(text.substr(internet.size()), endpoint.port)) {
    return endpoint;
  }
  throw BadInput(where, "expected unix:PATH or tcp:PORT, found '" + text + "'");
}

Listener::Listener(const Endpoint& endpoint, const std::string& where)
    : endpoint_(endpoint), socket_(socket_for(endpoint, SOCK_NONBLOCK)) {
  const Address address(endpoint);
  const int on = 1;
  if (endpoint.path.empty()) setsockopt(socket_.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const auto bind_fails = [&] { return bind(socket_.number(), address.get(), address.size()) != 0 ? errno : 0; };
  int reason = bind_fails();
  if (reason == EADDRINUSE && is_left_behind(endpoint, address)) {
    unlink(endpoint.path.c_str());
    reason = bind_fails();
  }
  if (reason == 0 && listen(socket_.number(), waiting_max) != 0) reason = errno;
  if (reason != 0) {
    endpoint_.path.clear();
    throw BadInput(where, "cannot listen at " + endpoint.text() + ": " + std::strerror(reason));
  }
  if (!endpoint.path.empty()) return;
  sockaddr_in given{};
  socklen_t size = sizeof given;
  getsockname(socket_.number(), reinterpret_cast<sockaddr*>(&given), &size);
  endpoint_.port = ntohs(given.sin_port);
}

Listener::~Listener() {
  if (!endpoint_.path.empty()) unlink(endpoint_.path.c_str());
}

Descriptor Listener::accept() {
  Descriptor connection(accept4(socket_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (connection) send_at_once(endpoint_, connection);
  return connection;
}

Descriptor connect_to(const Endpoint& endpoint, const std::string& where) {
  Descriptor connection = socket_for(endpoint, 0);
  if (!connects(connection, Address(endpoint)))
    throw BadInput(where, "cannot connect to " + endpoint.text() + ": " + std::strerror(errno));
  send_at_once(endpoint, connection);
  return connection;
}

}  // namespace waitpoint::outside
