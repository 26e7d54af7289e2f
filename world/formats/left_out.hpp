// SPDX-License-Identifier: BSD-3-Clause
// Warnings about unsupported parts of a file, which are never dropped silently: one line per kind of part, with a
// count.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::world {

class LeftOut {
 public:
  /// More kinds than these are only counted.
  static constexpr std::size_t kinds_max = 100;

  /// Notes a part at that line, with its kind and the consequence: "'light'", "is left out".
  void add(const std::string& file, int line, std::string_view what, std::string_view consequence);

  /// In the order of the first occurrence of each kind: "a.world:3: 'light' is left out (12 times)".
  std::vector<std::string> warnings() const;

 private:
  struct Kind {
    std::string file;
    int line;
    std::string what, consequence;
    std::size_t count;
  };
  std::vector<Kind> kinds_;
  std::size_t beyond_ = 0;
};

}  // namespace waitpoint::world
