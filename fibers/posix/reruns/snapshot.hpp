// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of a run: copies of its process by fork, stopped at a decision of the strategy, from which further runs
// with the same choices up to there begin instead of at main().
//
// A run makes one at the first decision after it has used some processor time since the one before; where it may make
// no more, the ones that save least are dropped. A snapshot connects to the explorer, which it serves like the process
// before main() (fork_server.hpp), and keeps the run's shared memory and output as they were. It ends when the explorer
// closes the connection.
//
// All system calls are followed meanwhile: after one that changes what a fork shares, such as a file, or that it does
// not copy, no snapshots are made any more.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace waitpoint::exploration {
class Explorer;
}

namespace waitpoint::posix {

/// The first packet of a snapshot, before ServerReady: its process.
struct SnapshotMade {
  pid_t process;
};

/// At the beginning of a run: makes snapshots of it, if they are asked for. In a run that begins in one, `begin_again`
/// is called, with the request in the record.
void begin_snapshots(void (*begin_again)());
/// Before a decision of `explorer`, which has made some. Returns again in each run that begins here.
void offer_snapshot(exploration::Explorer& explorer);

}  // namespace waitpoint::posix
