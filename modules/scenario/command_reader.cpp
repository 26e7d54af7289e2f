// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/command_reader.hpp"

namespace waitpoint::scenario {

std::vector<std::string> read_command(const YamlNode& node) {
  std::vector<std::string> words;
  for (const YamlNode& word : read_list(node, "command")) words.push_back(read_lines(word, "a word of a command"));
  if (words.empty() || words.front().empty()) throw node.written.bad("expected a program in the command, got none");
  if (words.front().find('/') != std::string::npos) words.front() = node.written.resolve(words.front()).string();
  return words;
}

}  // namespace waitpoint::scenario
