// SPDX-License-Identifier: BSD-3-Clause
// Substitution arguments in the texts of a launch file:
//
//   $(arg NAME)                the value of an argument
//   $(find PACKAGE)            the package's folder
//   $(env NAME)                the variable of the environment, which must be set
//   $(optenv NAME DEFAULT...)  the same, or the default, or nothing
//   $(anon WORD)               WORD_N with a number N of its own: the same one wherever the scope has WORD
//   $(dirname)                 the folder of the launch file
//   $(eval EXPRESSION)         as a whole text: launch_expression.hpp
//
// A '$' without '(' is itself. Texts that grow by substitution are bounded: 1 MiB each, 64 MiB together.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/location.hpp"
#include "modules/ros1/launch_scope.hpp"
#include "modules/ros1/launch_surroundings.hpp"

namespace waitpoint::ros1 {

class Substitution {
 public:
  /// Must not outlive `surroundings`.
  explicit Substitution(LaunchSurroundings& surroundings) : surroundings_(surroundings) {}

  /// `text` with all substitutions carried out. BadInput at `written` for a call that is none of the above, or fails.
  std::string of(std::string_view text, LaunchScope& scope, const Location& written);

  /// The value of one call, whose words are `words[0]`, the name, and its operands.
  std::string value_of_call(const std::vector<std::string>& words, LaunchScope& scope, const Location& written);

 private:
  /// The text, which counts for the bound of all.
  std::string counted(std::string text, const Location& written);
  std::string value_of_argument(const std::string& name, const LaunchScope& scope, const Location& written) const;

  LaunchSurroundings& surroundings_;
  int anonymous_names_ = 0;
  std::size_t bytes_ = 0;  // of all texts so far
};

}  // namespace waitpoint::ros1
