// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/outcome.hpp"

#include <algorithm>

namespace waitpoint::completeness {

std::string outcome(const std::string& end, const std::vector<std::size_t>& threads, const Observed& observed) {
  const bool is_single = end == "exit" || end == "misuse";
  std::string text = end + (threads.empty() || is_single ? "" : " {");
  for (const std::size_t thread : threads) text += (text.back() == '{' ? "" : " ") + std::to_string(thread);
  text += threads.empty() || is_single ? ":" : "}:";
  const bool is_whole = end == "ended" || end == "stuck";
  for (std::size_t t = 0; t < observed.reads.size(); ++t) {
    if (!is_whole && std::find(threads.begin(), threads.end(), t) == threads.end()) continue;
    text += " " + std::to_string(t) + "[";
    for (const int read : observed.reads[t]) text += (text.back() == '[' ? "" : " ") + std::to_string(read);
    text += "]";
  }
  if (!is_whole) return text;
  text += " memory";
  for (const int value : observed.values) text += " " + std::to_string(value);
  return text;
}

}  // namespace waitpoint::completeness
