// SPDX-License-Identifier: BSD-3-Clause
// What a file has and this world does not: told, never silently dropped. One line for each kind of thing, however often
// the file has it.
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

  /// Notes a thing at that line. `what` is its kind and `consequence` what that comes to: "'light'", "is left out".
  void add(const std::string& file, int line, std::string_view what, std::string_view consequence);

  /// In the order in which kinds came first: "a.world:3: 'light' is left out (12 times)".
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
