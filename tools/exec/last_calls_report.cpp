// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/last_calls_report.hpp"

#include <vector>

#include "fibers/posix/reports/last_calls.hpp"
#include "tools/exec/family_report.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t calls_shown = 8;

}  // namespace

std::string last_calls_of(const posix::Record& record) {
  const auto* const log = static_cast<const posix::LastCallsLog*>(common_of(record, posix::family::Part::last_calls));
  if (log == nullptr || log->threads.empty()) return "";
  std::vector<sync::CodePlaces> calls;
  calls.reserve(log->threads.size());
  for (const posix::LastCalls& thread : log->threads) calls.push_back(thread.calls);
  const auto lines = sync::user_source_lines(calls, calls_shown);
  std::string text = "call stacks:\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += "  " + log->threads[i].thread + "\n";
    for (const std::string& line : lines[i]) text += "      at " + line + "\n";
  }
  return text;
}

}  // namespace waitpoint::tools
