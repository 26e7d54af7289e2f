// SPDX-License-Identifier: BSD-3-Clause
// The events of a schedule in columns of JSON, as the page of a finding shows them.
//
//   t  time of each, less that of the one before    k  its task, an index of "tasks"
//   s  its time less that of the run                o  its operation
//                                                   x  its object, an index of "objects", or -1
//
// Events of one instant are a nanosecond apart, as in a trace: so their order can be seen.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "fibers/explore/report/timeline.hpp"

namespace waitpoint::exploration {

/// The most events of a schedule that a page shows.
inline constexpr std::size_t page_events_max = 200'000;

/// {"kind":"events",...,"marked":[...]}: beside the columns the tasks that wait when the run ends, with their objects,
/// the indices of events that were switches, and, for each of `marked`, its number in the run, from 1, or null if it is
/// not there. Of more than `events_max` events, those around the first that is marked, or else the last.
std::string to_columns(const Timeline& timeline, std::span<const EventOf> marked,
                       std::size_t events_max = page_events_max);

}  // namespace waitpoint::exploration
