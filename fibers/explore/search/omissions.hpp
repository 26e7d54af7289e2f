// SPDX-License-Identifier: BSD-3-Clause
// What an exhaustive search has left out, in all of its schedules.
#pragma once

#include <string>

#include "fibers/explore/schedules/explorer.hpp"

namespace waitpoint::exploration {

struct Omissions : LeftOut {
  bool accesses = false;  ///< switches at first accesses to memory
  bool values = false;    ///< values of loads

  bool any() const { return turns || costs || spurious || accesses || values; }
  /// ", except turns of spinning tasks and spurious wake-ups"; empty if there are none.
  std::string in_words() const;
};

}  // namespace waitpoint::exploration
