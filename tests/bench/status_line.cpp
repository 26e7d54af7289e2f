// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/status_line.hpp"

#include <unistd.h>

#include <algorithm>

namespace waitpoint::bench {

void StatusLine::show(std::string_view text) {
  if (stream_ == nullptr || (text.empty() && shown_ == 0)) return;
  const int size = static_cast<int>(text.size()), width = static_cast<int>(std::max(text.size(), shown_));
  std::fprintf(stream_, "\r%-*.*s%s", width, size, text.data(), text.empty() ? "\r" : "");
  std::fflush(stream_);
  shown_ = text.size();
}

bool is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace waitpoint::bench
