// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/connections.hpp"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>

#include "core/digest.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
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

/// An epoll descriptor and one that it watches. The system keeps a watch when the descriptor is closed that has a
/// duplicate: so does the list.
struct Watch {
  int epoll;
  int descriptor;
  epoll_event what;
};
Watch* watches = nullptr;
std::size_t watch_count = 0, watch_room = 0;

/// Of an epoll descriptor whose watches are all in the list.
enum class Watching : std::uint8_t { nothing, listed, unknown };
Watching watching[known_descriptors_max];

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
  if (watching[epoll] == Watching::unknown) return family::of_descriptors;
  family::Changes all = 0;
  for (std::size_t i = 0; i < watch_count; ++i) {
    const Watch& watch = watches[i];
    if (watch.epoll != epoll) continue;
    const short events = static_cast<short>(((watch.what.events & EPOLLIN) != 0 ? POLLIN : 0) |
                                            ((watch.what.events & EPOLLOUT) != 0 ? POLLOUT : 0));
    all |= changes_at(watch.descriptor, events);
  }
  return all;
}

}  // namespace

family::Changes changes_at(int descriptor, short events) {
  if (!is_in_range(descriptor)) return family::of_descriptors;
  if (watching[descriptor] != Watching::nothing) return awaited_by_epoll(descriptor);
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

void note_watch(int epoll, int descriptor, const epoll_event& what) {
  if (!is_in_range(epoll)) return;
  if (watching[epoll] == Watching::nothing) watching[epoll] = Watching::listed;
  for (std::size_t i = 0; i < watch_count; ++i)
    if (watches[i].epoll == epoll && watches[i].descriptor == descriptor) return void(watches[i].what = what);
  if (watch_count == watch_room) {
    const std::size_t room = 2 * watch_room + 32;
    auto* const more = static_cast<Watch*>(std::realloc(watches, room * sizeof(Watch)));
    if (more == nullptr) return void(watching[epoll] = Watching::unknown);
    watches = more;
    watch_room = room;
  }
  watches[watch_count++] = {epoll, descriptor, what};
}

void end_watch(int epoll, int descriptor) {
  for (std::size_t i = 0; i < watch_count; ++i)
    if (watches[i].epoll == epoll && watches[i].descriptor == descriptor)
      return void(watches[i] = watches[--watch_count]);
}

void put_in_order(int epoll, epoll_event* events, int count) {
  if (count < 2 || !is_in_range(epoll) || watching[epoll] != Watching::listed) return;
  int in_order = 0;
  for (std::size_t i = 0; i < watch_count && in_order < count; ++i) {
    if (watches[i].epoll != epoll) continue;
    for (int k = in_order; k < count; ++k) {
      if (events[k].data.u64 != watches[i].what.data.u64) continue;
      std::rotate(events + in_order, events + k, events + k + 1);
      ++in_order;
      break;
    }
  }
}

void note_shared_epoll(int from, int made) {
  if (!is_in_range(from) || !is_in_range(made) || watching[from] == Watching::nothing) return;
  watching[from] = watching[made] = Watching::unknown;
}

void note_shared_epolls() {
  for (std::size_t i = 0; i < watch_count; ++i) watching[watches[i].epoll] = Watching::unknown;
}

void forget_connection(int descriptor) {
  if (!is_in_range(descriptor)) return;
  connections[descriptor] = {};
  for (std::size_t i = 0; i < listening_count; ++i)
    if (listening[i] == descriptor) listening[i] = listening[--listening_count];
  if (watching[descriptor] == Watching::nothing) return;
  watching[descriptor] = Watching::nothing;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < watch_count; ++i)
    if (watches[i].epoll != descriptor) watches[kept++] = watches[i];
  watch_count = kept;
}

}  // namespace waitpoint::posix
