// SPDX-License-Identifier: BSD-3-Clause
// How long our geometry is compared with FCL's.
#pragma once

#include <cstdlib>

namespace waitpoint::world {

/// Random placements to try: WAITPOINT_PLACEMENTS where it is set (`./dev test --agreement`), else so many.
inline long placements(long usual) {
  const char* const wanted = std::getenv("WAITPOINT_PLACEMENTS");
  return wanted != nullptr ? std::strtol(wanted, nullptr, 10) : usual;
}

}  // namespace waitpoint::world
