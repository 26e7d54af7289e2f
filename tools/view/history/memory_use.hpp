// SPDX-License-Identifier: BSD-3-Clause
// The memory of this process, to weigh the cost of snapshots: nothing of a run depends on it.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <fstream>

namespace waitpoint::tools::view {

struct MemoryUse {
  std::uint64_t bytes = 0;         ///< present
  std::uint64_t copied_bytes = 0;  ///< so far, of pages that were copied, or taken for the first time
};

inline MemoryUse memory_use() {
  constexpr std::uint64_t page_bytes = 4096;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::uint64_t mapped = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> mapped >> resident;
  return {resident * page_bytes, static_cast<std::uint64_t>(usage.ru_minflt) * page_bytes};
}

}  // namespace waitpoint::tools::view
