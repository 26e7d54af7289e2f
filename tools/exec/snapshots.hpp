// SPDX-License-Identifier: BSD-3-Clause
// The snapshots that runs have made of themselves (fibers/posix/reruns/snapshot.hpp), as the explorer's process sees
// them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fibers/posix/reruns/rerun_control.hpp"

namespace waitpoint::tools {

/// The connection to a snapshot, which ends with it.
class Snapshot {
 public:
  Snapshot(int socket, std::uint32_t decision) : socket_(socket), decision_(decision) {}
  ~Snapshot();
  Snapshot(Snapshot&& other) noexcept : socket_(std::exchange(other.socket_, -1)), decision_(other.decision_) {}
  Snapshot& operator=(Snapshot&& other) noexcept {
    std::swap(socket_, other.socket_);
    decision_ = other.decision_;
    return *this;
  }

  int socket() const { return socket_; }
  /// The decision before which it stopped, counted from 0.
  std::uint32_t decision() const { return decision_; }

 private:
  int socket_;
  std::uint32_t decision_;
};

/// The snapshots that a run may make.
struct SnapshotsAsked {
  std::uint32_t most = 0;
  bool at_first_decision_only = false;
};

class SnapshotListener {
 public:
  /// Tells its address to the runs.
  explicit SnapshotListener(posix::RerunControl& control);
  ~SnapshotListener();
  SnapshotListener(const SnapshotListener&) = delete;
  SnapshotListener& operator=(const SnapshotListener&) = delete;

  /// Before a run.
  void ask_for(const SnapshotsAsked& asked);
  /// After it: the snapshots that it has made and kept, in the order of their decisions.
  std::vector<Snapshot> take();

 private:
  posix::RerunControl& control_;
  int socket_;
};

}  // namespace waitpoint::tools
