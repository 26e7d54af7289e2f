// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/post_mortem.hpp"

#include <unistd.h>
#include <unwind.h>

#include <algorithm>
#include <cstdio>

#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"

namespace waitpoint::sync {
namespace {

/// Removes the frames of the report of a misuse, so that the first one is its caller.
void remove_report(ReturnAddresses& stack) {
  const auto is_report = [](void* address) {
    return _Unwind_FindEnclosingFunction(static_cast<char*>(address) - 1) == reinterpret_cast<void*>(&misuse);
  };
  const auto report = std::find_if(stack.begin(), stack.end(), is_report);
  if (report != stack.end()) stack.erase(stack.begin(), report + 1);
}

}  // namespace

void write_call_stack(const char*) {
  constexpr std::size_t frames_searched = 64, frames_shown = 20;
  ReturnAddresses stack(frames_searched);
  stack.resize(kernel::capture_call_stack(stack.data(), stack.size()));
  remove_report(stack);
  const ReturnAddresses stacks[] = {stack};
  const std::vector<std::vector<std::string>> lines = user_source_lines(stacks, frames_shown);
  for (const std::string& line : lines.front()) dprintf(STDERR_FILENO, "  %s\n", line.c_str());
  tell_system_calls();
}

}  // namespace waitpoint::sync
