// SPDX-License-Identifier: BSD-3-Clause
// The events of a picture's operations as consecutive columns: a history's part has gaps where the other parts have
// their events.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fibers/explore/linearizability/history_picture.hpp"

namespace waitpoint::exploration {

class HistoryColumns {
 public:
  explicit HistoryColumns(const HistoryPicture& picture) {
    for (const HistoryRow& row : picture.rows)
      for (const std::uint32_t event : {row.interval.invoked, row.interval.responded})
        if (event != Interval::pending) events_.push_back(event);
    std::sort(events_.begin(), events_.end());
  }

  std::size_t count() const { return events_.size(); }
  /// The event's column, from 0; count() for the response of a pending operation.
  std::size_t operator[](std::uint32_t event) const {
    return static_cast<std::size_t>(std::lower_bound(events_.begin(), events_.end(), event) - events_.begin());
  }

 private:
  std::vector<std::uint32_t> events_;
};

}  // namespace waitpoint::exploration
