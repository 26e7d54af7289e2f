// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/module_lines.hpp"

#include <algorithm>
#include <vector>

namespace waitpoint::tools::view {

Json take_lines(std::deque<ModuleLog>& logs) {
  struct Line {
    std::size_t robot;
    ModuleLog::Line line;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < logs.size(); ++i)
    for (ModuleLog::Line& line : logs[i].take()) lines.push_back({i, std::move(line)});
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.line.date < b.line.date; });
  Json json = Json::array();
  for (const Line& line : lines)
    json.push_back({line.line.date.ns(), line.robot, line.line.module, line.line.text, line.line.is_bad});
  return json;
}

}  // namespace waitpoint::tools::view
