// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/misuse_report.hpp"

#include <fmt/format.h>

#include <vector>

#include "fibers/posix/reports/misuse_log.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "tools/exec/family_report.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t frames_shown = 8;

const std::vector<posix::LoggedMisuse>& misuse_log_of(const posix::Record& record) {
  static const std::vector<posix::LoggedMisuse> none;
  const auto* const log = static_cast<const posix::MisuseLog*>(common_of(record, posix::family::Part::misuses));
  return log != nullptr ? log->misuses : none;
}

}  // namespace

std::string first_misuse(const posix::Record& record) {
  return misuse_log_of(record).empty() ? "" : misuse_log_of(record).front().sentence;
}

std::string misuses_of(const posix::Record& record) {
  const std::vector<posix::LoggedMisuse>& all = misuse_log_of(record);
  if (all.empty()) return "";
  std::vector<sync::CodePlaces> calls;
  calls.reserve(all.size());
  for (const posix::LoggedMisuse& one : all) calls.push_back(one.calls);
  const auto lines = sync::user_source_lines(calls, frames_shown);
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += fmt::format("misuse at {} s: {}\n", to_string(all[i].time), all[i].sentence);
    for (const std::string& line : lines[i]) text += "    at " + line + "\n";
  }
  return text;
}

}  // namespace waitpoint::tools
