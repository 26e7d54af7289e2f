// SPDX-License-Identifier: BSD-3-Clause
// The length of comparisons of this project's geometry with FCL's.
#pragma once

#include <cstdlib>

namespace waitpoint::world {

/// The number of random placements: WAITPOINT_PLACEMENTS if set (`./dev test --agreement`), else this default.
inline long placements(long usual) {
  const char* const wanted = std::getenv("WAITPOINT_PLACEMENTS");
  return wanted != nullptr ? std::strtol(wanted, nullptr, 10) : usual;
}

}  // namespace waitpoint::world
