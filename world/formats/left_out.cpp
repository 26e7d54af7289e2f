// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/left_out.hpp"

#include "core/printable_line.hpp"

namespace waitpoint::world {

void LeftOut::add(const std::string& file, int line, std::string_view what, std::string_view consequence) {
  for (Kind& kind : kinds_) {
    if (kind.what != what || kind.consequence != consequence) continue;
    ++kind.count;
    return;
  }
  if (kinds_.size() == kinds_max) {
    ++beyond_;
  } else {
    kinds_.push_back({file, line, std::string(what), std::string(consequence), 1});
  }
}

std::vector<std::string> LeftOut::warnings() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    std::string line =
        printable_line(kind.file + ":" + std::to_string(kind.line) + ": " + kind.what + " " + kind.consequence);
    if (kind.count > 1) line += " (" + std::to_string(kind.count) + " times)";
    lines.push_back(line);
  }
  if (beyond_ > 0)
    lines.push_back(printable_line(kinds_.front().file) + ": " + std::to_string(beyond_) + " more things are left out");
  return lines;
}

}  // namespace waitpoint::world
