// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/snapshots.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>

#include "core/error.hpp"
#include "fibers/posix/reruns/fork_server.hpp"
#include "fibers/posix/reruns/snapshot.hpp"

namespace waitpoint::tools {

Snapshot::~Snapshot() {
  if (socket_ >= 0) close(socket_);
}

SnapshotListener::SnapshotListener(posix::RerunControl& control)
    : control_(control), socket_(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  auto* const of_any_family = reinterpret_cast<sockaddr*>(&address);
  socklen_t named = sizeof address;  // without a name the system chooses one
  if (socket_ < 0 || bind(socket_, of_any_family, sizeof address.sun_family) != 0 || listen(socket_, SOMAXCONN) != 0 ||
      getsockname(socket_, of_any_family, &named) != 0)
    throw BadInput("exec", std::string("cannot listen at a socket: ") + std::strerror(errno));
  const std::size_t bytes = named - offsetof(sockaddr_un, sun_path);
  WAITPOINT_CHECK(bytes <= sizeof control.listener, "the system chose a long name for a socket");
  std::memcpy(control.listener, address.sun_path, bytes);
  control.listener_bytes = static_cast<std::uint32_t>(bytes);
}

SnapshotListener::~SnapshotListener() { close(socket_); }

void SnapshotListener::ask_for(const SnapshotsAsked& asked) {
  control_.room = std::min(asked.most, posix::RerunControl::snapshots_max);
  control_.at_first_only = asked.at_first_decision_only;
  control_.snapshots_made = 0;
}

// They connect as they begin; those that a run has dropped may be among them, and are gone.
std::vector<Snapshot> SnapshotListener::take() {
  constexpr int patience_ms = 2000;
  const std::span made(control_.snapshots, std::min(control_.snapshots_made, posix::RerunControl::snapshots_max));
  std::vector<Snapshot> taken;
  pollfd one{socket_, POLLIN, 0};
  while (taken.size() < made.size() && poll(&one, 1, patience_ms) > 0) {
    const int connected = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connected < 0) break;
    posix::SnapshotMade who{};
    posix::ServerReady ready;
    const bool is_there =
        recv(connected, &who, sizeof who, 0) == sizeof who && recv(connected, &ready, sizeof ready, 0) == sizeof ready;
    const auto found = std::ranges::find(made, who.process, &posix::RerunControl::Snapshot::process);
    if (is_there && found != made.end())
      taken.emplace_back(connected, found->decision);
    else
      close(connected);
  }
  std::ranges::sort(taken, {}, &Snapshot::decision);
  return taken;
}

}  // namespace waitpoint::tools
