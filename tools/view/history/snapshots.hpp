// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of a run, bounded in number and in memory. A copy shares the memory of the run, but for the pages that the
// run has written since: these are its cost.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/time.hpp"
#include "tools/view/history/copies.hpp"

namespace waitpoint::tools::view {

struct Snapshot {
  Time time;
  std::uint64_t events;  ///< so far
  std::shared_ptr<Peer> peer;
  std::uint64_t copied_bytes = 0;  ///< that the run wrote from here to the next one
};

/// The memory that they may hold: an eighth of the machine's memory, at most 2 GiB.
std::uint64_t snapshot_bytes_max();

/// Gives up every second one, but the first and the last and those that are in use, once they are too many or hold more
/// than `bytes_max`; again if that is not enough. `leave` is called with each.
void thin_out(std::vector<Snapshot>& snapshots, std::uint64_t bytes_max, const Copies::Use& leave);

}  // namespace waitpoint::tools::view
