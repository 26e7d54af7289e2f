// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/race_report.hpp"

#include <map>
#include <sstream>
#include <utility>

#include "fibers/posix/reports/race_log.hpp"
#include "tools/exec/family_report.hpp"

namespace waitpoint::tools {
namespace {

// Null without an instrumented program.
const posix::RaceLog* log_of(const posix::Record& record) {
  return static_cast<const posix::RaceLog*>(common_of(record, posix::family::Part::races));
}

}  // namespace

std::vector<RacesOf> races_by_process(const posix::Record& record) {
  if (!has_races(record)) return {};
  // A process that executes several programs has several names.
  std::map<std::pair<pid_t, std::string>, std::vector<races::LocatedRace>> of_processes;
  for (const posix::RaceOfProcess& one : log_of(record)->races)
    of_processes[{one.process, one.program}].push_back(one.race);
  std::vector<RacesOf> all;
  all.reserve(of_processes.size());
  for (const auto& [process, found] : of_processes)
    all.push_back({family_of(record).made > 1 ? process.second : "", races::in_words(found)});
  return all;
}

std::string races_of(const posix::Record& record) {
  std::ostringstream text;
  for (const auto& [process, found] : races_by_process(record)) {
    if (!process.empty()) text << "data races of " << process << ":\n";
    for (const races::Race& race : found) text << race;
  }
  return text.str();
}

bool has_races(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr && !log->races.empty();
}

bool has_unlearned_code(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr && log->has_other_code;
}

bool has_left_out_values(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr && log->has_left_out_values;
}

bool has_lost_breakpoints(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr && log->has_lost_breakpoints;
}

std::vector<races::LocatedRace> located_races(const posix::Record& record) {
  std::vector<races::LocatedRace> all;
  if (has_races(record))
    for (const posix::RaceOfProcess& one : log_of(record)->races) all.push_back(one.race);
  return all;
}

std::span<const std::uint64_t> code_of(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr ? std::span<const std::uint64_t>(log->code) : std::span<const std::uint64_t>();
}

}  // namespace waitpoint::tools
