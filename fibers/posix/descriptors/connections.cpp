// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/connections.hpp"

#include <poll.h>
#include <sys/socket.h>

#include "core/digest.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/epoll_watches.hpp"
#include "fibers/posix/descriptors/inside_files.hpp"
#include "fibers/posix/descriptors/internet_address.hpp"
#include "fibers/posix/descriptors/partners.hpp"

namespace waitpoint::posix {
namespace {

/// What this process knows of a socket, once it is connected or listens.
struct Connection {
  bool is_known;
  bool is_within_family;
  family::Changes incoming, outgoing;
};
Connection connections[known_descriptors_max];

/// The sockets that listen, as far as they were asked for.
constexpr std::size_t listening_max = 64;
int listening[listening_max];
std::size_t listening_count = 0;

bool is_in_range(int descriptor) { return descriptor >= 0 && descriptor < known_descriptors_max; }

// By a number that is the same in every run, as ports are not: a check in vain may come before others of its instant.
family::Changes of_flow(std::uint32_t connection, bool from_its_maker) {
  return family::of_stream(Digest::mix(2 * std::uint64_t{connection} + (from_its_maker ? 1 : 0)));
}

bool listens(int descriptor) {
  int value = 0;
  socklen_t size = sizeof value;
  return WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_ACCEPTCONN, &value, &size) == 0 && value == 1;
}

bool is_stream_socket(int descriptor) {
  int value = 0;
  socklen_t size = sizeof value;
  return WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_TYPE, &value, &size) == 0 && value == SOCK_STREAM;
}

// Null while it is no socket that is connected or listens.
const Connection* connection_of(int descriptor) {
  Connection& known = connections[descriptor];
  if (known.is_known) return &known;
  const ErrorNumberKept kept;
  if (!is_stream_socket(descriptor)) return nullptr;
  if (listens(descriptor)) {
    known = {true, false, family::of_connecting, family::of_descriptors};
    if (listening_count < listening_max) listening[listening_count++] = descriptor;
    return &known;
  }
  InternetAddress own{}, peer{};
  if (!read_own_address(descriptor, own) || !read_peer_address(descriptor, peer)) return nullptr;
  const std::uint32_t from_here = connection_from(port_of(own)), from_peer = connection_from(port_of(peer));
  if ((from_here == 0) == (from_peer == 0) || partner_at(descriptor) != Partner::none) return nullptr;
  const bool is_made_here = from_here != 0;
  const std::uint32_t number = is_made_here ? from_here : from_peer;
  known = {true, true, of_flow(number, !is_made_here), of_flow(number, is_made_here)};
  return &known;
}

family::Changes awaited_by_epoll(int epoll) {
  if (!are_watches_known(epoll)) return family::of_descriptors;
  family::Changes all = 0;
  for (const EpollWatch* watch = next_watch(epoll, nullptr); watch != nullptr; watch = next_watch(epoll, watch)) {
    const bool reads = (watch->what.events & EPOLLIN) != 0, writes = (watch->what.events & EPOLLOUT) != 0;
    all |= changes_at(watch->descriptor, static_cast<short>((reads ? POLLIN : 0) | (writes ? POLLOUT : 0)));
  }
  return all;
}

}  // namespace

family::Changes changes_at(int descriptor, short events) {
  if (!is_in_range(descriptor)) return family::of_descriptors;
  if (watches_others(descriptor)) return awaited_by_epoll(descriptor);
  if (const InsideFile* const pipe = pipe_inside(descriptor)) return family::of_stream(pipe->number);
  if (is_inside(descriptor)) return family::of_descriptors;
  const Connection* const connection = connection_of(descriptor);
  if (connection == nullptr) return family::of_descriptors;
  // Without a direction the end of the stream is awaited, which changes all.
  const bool writes = (events & POLLOUT) != 0, reads = !writes || (events & (POLLIN | POLLPRI | POLLRDHUP)) != 0;
  return (reads ? connection->incoming : 0) | (writes ? connection->outgoing : 0);
}

void await_connections() {
  for (std::size_t i = 0; i < listening_count; ++i) await_connection(listening[i]);
}

bool is_within_family(int descriptor) {
  if (!is_in_range(descriptor) || is_inside(descriptor)) return false;
  const Connection* const connection = connection_of(descriptor);
  return connection != nullptr && connection->is_within_family;
}

void forget_connection(int descriptor) {
  if (!is_in_range(descriptor)) return;
  connections[descriptor] = {};
  for (std::size_t i = 0; i < listening_count; ++i)
    if (listening[i] == descriptor) listening[i] = listening[--listening_count];
}

}  // namespace waitpoint::posix
