// SPDX-License-Identifier: BSD-3-Clause
// Command lines of `waitpoint`: one argument per line.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/refusal.hpp"
#include "tools/options.hpp"

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  std::vector<std::string> words = {"waitpoint"};
  for (std::string line; std::getline(lines, line);) words.push_back(line.substr(0, line.find('\0')));
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  fuzz::reads_or_refuses(
      [&] { tools::read_options(static_cast<int>(words.size()), arguments.data(), "waitpoint 0\n"); });
  return 0;
}
