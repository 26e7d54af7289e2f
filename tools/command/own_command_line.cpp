// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/own_command_line.hpp"

#include <cstdlib>
#include <fstream>

namespace waitpoint::tools {

bool repeats_command_line() { return std::getenv(layer_variable) != nullptr || std::getenv(check_variable) != nullptr; }

std::vector<std::string> own_command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> result;
  result.reserve(words.size() + 1);
  for (const std::string& word : words) result.push_back(const_cast<char*>(word.c_str()));
  result.push_back(nullptr);
  return result;
}

}  // namespace waitpoint::tools
