// SPDX-License-Identifier: BSD-3-Clause
// The state of the machine, as the program sees it: nothing else runs, half of the memory and of each file system is
// free, and the time since its start is the virtual one. Of the real machine are its size and the number of processors.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct MachineState {
  MachineState();
  std::uint64_t memory_bytes;  ///< half of it is free
  std::int64_t uptime_ns;      ///< of the running thread's time
  int processes;               ///< of the family, that have not ended
};

/// Of each process, in bytes: as much is in memory.
inline constexpr std::uint64_t process_memory_bytes = std::uint64_t{16} << 20;

}  // namespace waitpoint::posix
