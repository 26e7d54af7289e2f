// SPDX-License-Identifier: BSD-3-Clause
#include "world/kinematic/expected_scans.hpp"

#include <utility>

#include "core/error.hpp"

namespace waitpoint::world {

void ExpectedScans::List::clear() {
  for (const Entry& entry : entries) of_body[entry.body] = none;
  entries.clear();
}

void ExpectedScans::restart(std::size_t bodies) {
  for (List* list : {&next_, &made_}) {
    list->entries.clear();
    list->of_body.assign(bodies, none);
  }
  valid_ = false;
}

void ExpectedScans::expect(std::uint32_t body, std::uint32_t laser, std::uint64_t number) {
  std::uint32_t& last = next_.of_body.at(body);
  WAITPOINT_FAST_CHECK(last == none || last < next_.entries.size(), "a body's list begins beyond its end");
  next_.entries.push_back({body, laser, number, last});
  last = static_cast<std::uint32_t>(next_.entries.size() - 1);
}

bool ExpectedScans::begin() {
  made_.clear();
  std::swap(made_, next_);
  ranges_m_.clear();
  WAITPOINT_FAST_CHECK(made_.of_body.size() == next_.of_body.size(), "two lists of scans are of different bodies");
  valid_ = !made_.entries.empty();
  return valid_;
}

bool ExpectedScans::find(std::uint32_t body, std::uint32_t laser, std::uint64_t number, LaserScan& out) const {
  if (!valid_) return false;
  for (std::uint32_t at = made_.of_body[body]; at != none; at = made_.entries[at].next_of_body) {
    const Entry& entry = made_.entries[at];
    if (entry.laser != laser || entry.number != number) continue;
    out.first_angle_rad = entry.first_angle_rad;
    out.angle_step_rad = entry.angle_step_rad;
    out.range_max_m = entry.range_max_m;
    WAITPOINT_CHECK(std::size_t{entry.first_range} + entry.ranges <= ranges_m_.size(), "a scan lies beyond its array");
    const double* const first = ranges_m_.data() + entry.first_range;
    out.range_m.assign(first, first + entry.ranges);
    return true;
  }
  return false;
}

}  // namespace waitpoint::world
