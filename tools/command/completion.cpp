// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/completion.hpp"

#include <string_view>

namespace waitpoint::tools {
namespace {

/// The script with the program's name in the place of "waitpoint".
std::string renamed(const std::string& script, const std::string& own) {
  constexpr std::string_view name = "waitpoint";
  std::string text;
  std::size_t begin = 0;
  for (std::size_t at = 0; (at = script.find(name, begin)) != script.npos; begin = at + name.size())
    text += script.substr(begin, at - begin) + own;
  return text + script.substr(begin);
}

}  // namespace

std::string completion(const DeclaredProgram& program, const std::string& shell) {
  const std::string script = shell == "bash"  ? bash_completion(program)
                             : shell == "zsh" ? zsh_completion(program)
                                              : fish_completion(program);
  return renamed(script, program.name);
}

}  // namespace waitpoint::tools
