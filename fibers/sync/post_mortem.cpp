// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/post_mortem.hpp"

#include <unistd.h>

#include <cstdio>

#include "fibers/kernel/call_stack.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::sync {

void write_call_stack(const char*) {
  constexpr std::size_t frames_searched = 64, frames_shown = 20;
  ReturnAddresses stack(frames_searched);
  stack.resize(kernel::capture_call_stack(stack.data(), stack.size()));
  const ReturnAddresses stacks[] = {stack};
  const std::vector<std::vector<std::string>> lines = user_source_lines(stacks, frames_shown);
  for (const std::string& line : lines.front()) dprintf(STDERR_FILENO, "  %s\n", line.c_str());
}

}  // namespace waitpoint::sync
