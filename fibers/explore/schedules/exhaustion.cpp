// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/exhaustion.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::exploration {

// True if it is new.
bool Exhaustion::take(std::uint64_t trace, std::uint8_t by) {
  const auto [known, is_new] = traces_.try_emplace(trace, std::uint8_t{0});
  const std::uint8_t before = known->second;
  known->second |= by;
  only_drawn_ += known->second == by_draw;
  only_drawn_ -= before == by_draw;
  return is_new;
}

void Exhaustion::take_drawn(std::uint64_t trace, bool is_beyond) {
  ++drawn_;
  known_ = take(trace, is_beyond ? 0 : by_draw) ? 0 : known_ + 1;
  has_begun_ = has_begun_ || known_ >= std::max(least_known, times_distinct * distinct());
}

void Exhaustion::take_enumerated(std::uint64_t trace) {
  ++enumerated_;
  take(trace, by_enumeration);
}

bool Exhaustion::end_enumeration(bool has_all) {
  if (has_all && is_complete()) return true;
  is_unproved_ = !std::exchange(leaves_out_equivalent_, false);
  return false;
}

}  // namespace waitpoint::exploration
