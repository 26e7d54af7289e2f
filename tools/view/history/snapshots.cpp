// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/snapshots.hpp"

#include <unistd.h>

#include <algorithm>

namespace waitpoint::tools::view {
namespace {

constexpr std::size_t snapshots_max = 48;

std::uint64_t bytes_of(const std::vector<Snapshot>& snapshots) {
  std::uint64_t sum = 0;
  for (const Snapshot& snapshot : snapshots) sum += snapshot.copied_bytes;
  return sum;
}

// A run writes the same pages again and again: the one before such a snapshot holds hardly more than it did.
void give_up_every_second(std::vector<Snapshot>& snapshots, const Copies::Use& leave) {
  std::vector<Snapshot> kept;
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    if (i % 2 == 0 || i + 1 == snapshots.size() || !snapshots[i].peer->is_idle()) {
      kept.push_back(snapshots[i]);
      continue;
    }
    kept.back().copied_bytes = std::max(kept.back().copied_bytes, snapshots[i].copied_bytes);
    leave(snapshots[i].peer);
  }
  snapshots = std::move(kept);
}

}  // namespace

std::uint64_t snapshot_bytes_max() {
  constexpr std::uint64_t most = std::uint64_t{2} << 30, share = 8;
  const auto machine =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return std::min(most, machine / share);
}

void thin_out(std::vector<Snapshot>& snapshots, std::uint64_t bytes_max, const Copies::Use& leave) {
  constexpr std::size_t least = 2;
  while (snapshots.size() > least && (snapshots.size() > snapshots_max || bytes_of(snapshots) > bytes_max)) {
    const std::size_t before = snapshots.size();
    give_up_every_second(snapshots, leave);
    if (snapshots.size() == before) return;
  }
}

}  // namespace waitpoint::tools::view
