// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a history that has no linearization: a row for each operation, a bar from its invocation to its response.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/linearizability/interval.hpp"

namespace waitpoint::exploration {

struct HistoryRow {
  std::string task;
  std::string operation;  ///< with its result: "pop -> 1"
  Interval interval;
  std::size_t place = 0;  ///< in the linearization of the longest linearizable prefix, counted from 1; 0: not in it
};

struct HistoryPicture {
  std::vector<HistoryRow> rows;    ///< in the order of invocation
  std::optional<std::size_t> bad;  ///< the row whose response ends the longest linearizable prefix; none: not known
};

/// A table with a column for each event, of at most a hundred events: those around the end of the prefix. No line break
/// at the end.
std::string to_text(const HistoryPicture& picture);

/// The whole history as a document of scalable vector graphics.
std::string to_svg(const HistoryPicture& picture);

}  // namespace waitpoint::exploration
