// SPDX-License-Identifier: BSD-3-Clause
#include "core/number_text.hpp"
#include "fibers/explore/linearizability/history_columns.hpp"
#include "fibers/explore/linearizability/history_picture.hpp"

namespace waitpoint::exploration {
namespace {

constexpr std::size_t columns_max = 100;
constexpr std::size_t columns_after = 20;  // the prefix's end

// The columns that are shown, `end` excluded.
struct Window {
  std::size_t from, end;
};

Window window_around(std::size_t column, std::size_t count) {
  const std::size_t end = std::min(count, std::max(column + 1 + columns_after, columns_max));
  return {end > columns_max ? end - columns_max : 0, end};
}

std::string left(const std::string& text, std::size_t width) { return text + std::string(width - text.size(), ' '); }

// "[--]" from the invocation to the response, '!' in place of a bad one's response; '>' if it ends beyond the window.
std::string bar(std::size_t from, std::size_t to, Window window, bool is_bad) {
  std::string text;
  for (std::size_t column = window.from; column < window.end && column <= to; ++column)
    text += column < from ? ' ' : column == from ? '[' : column < to ? '-' : is_bad ? '!' : ']';
  if (to >= window.end) text += '>';
  return text;
}

std::string place_text(const HistoryPicture& picture, std::size_t row) {
  if (picture.bad == row) return "!";
  return picture.rows[row].place == 0 ? "-" : std::to_string(picture.rows[row].place);
}

}  // namespace

std::string to_text(const HistoryPicture& picture) {
  const HistoryColumns columns(picture);
  const std::size_t last = picture.bad ? columns[picture.rows[*picture.bad].interval.responded]
                                       : std::max<std::size_t>(columns.count(), 1) - 1;
  const Window window = window_around(last, columns.count());
  std::size_t tasks = 4, operations = 9, earlier = 0, later = 0;  // the widths of the heads
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < picture.rows.size(); ++i) {
    const HistoryRow& row = picture.rows[i];
    if (columns[row.interval.responded] < window.from) {
      ++earlier;
    } else if (columns[row.interval.invoked] >= window.end) {
      ++later;
    } else {
      shown.push_back(i);
      tasks = std::max(tasks, row.task.size());
      operations = std::max(operations, row.operation.size());
    }
  }
  std::string text;
  if (earlier > 0) text += "(" + counted(earlier, "operation") + " responded before these)\n";
  text += "place  " + left("task", tasks) + "  " + left("operation", operations) + "  events\n";
  for (const std::size_t i : shown) {
    const HistoryRow& row = picture.rows[i];
    const std::string place = place_text(picture, i);
    text += std::string(5 - std::min<std::size_t>(5, place.size()), ' ') + place + "  " + left(row.task, tasks) + "  " +
            left(row.operation, operations) + "  " +
            bar(columns[row.interval.invoked], columns[row.interval.responded], window, picture.bad == i) + "\n";
  }
  if (picture.bad)
    text += std::string(5 + 2 + tasks + 2 + operations + 2 + (last - window.from), ' ') + "^ end of the prefix\n";
  if (later > 0)
    text += "(" + counted(later, "operation") + (later == 1 ? " was" : " were") + " invoked after these)\n";
  text.pop_back();
  return text;
}

}  // namespace waitpoint::exploration
