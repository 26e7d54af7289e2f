// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/family_report.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>

#include "core/number_text.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/family/processes.hpp"

namespace waitpoint::tools {
namespace {

using posix::family::Family;
using posix::family::Process;

template <class Visit>
void for_each_other(const Family& family, Visit visit) {
  for (const Process& process : entries_of(family))
    if (&process != family.processes && process.state != Process::State::none) visit(process);
}

bool is_in_system(const Process& process) {
  const bool is_there = process.state == Process::State::alive || process.state == Process::State::stopped;
  return is_there && process.real_id > 0;
}

}  // namespace

// Zero before the run.
Family& family_of(const posix::Record& record) {
  const char* const memory = reinterpret_cast<const char*>(&record) + posix::record_bytes;
  return *reinterpret_cast<Family*>(const_cast<char*>(memory));
}

const void* common_of(const posix::Record& record, posix::family::Part part) {
  return family_of(record).parts[static_cast<int>(part)];
}

const posix::History* history_of(const posix::Record& record) {
  return static_cast<const posix::History*>(common_of(record, posix::family::Part::history));
}

bool is_single(const posix::Record& record) {
  const Family& family = family_of(record);
  return family.made < 2 && family.digest_of_ended == 0;
}

Digest digest_of(const posix::Record& record) {
  if (is_single(record)) return record.digest();
  const Family& family = family_of(record);
  std::uint64_t of_others = family.digest_of_ended;
  for_each_other(family, [&of_others](const Process& process) {
    of_others += posix::family::share_of_digest(process.id, process.digest);
  });
  Digest all;
  all.add(record.digest().value());
  all.add(of_others);
  return all;
}

std::uint64_t events_of(const posix::Record& record) {
  const Family& family = family_of(record);
  std::uint64_t events = kernel::events(record.scheduler()) + family.events_of_ended;
  for_each_other(family, [&events](const Process& process) { events += process.digest.pairs(); });
  return events;
}

Time time_of(const posix::Record& record) {
  return std::max(kernel::global_time(record.scheduler()), family_of(record).now);
}

pid_t process_in_turn(const posix::Record& record) {
  const Family& family = family_of(record);
  return family.processes[family.holder.load() % posix::family::processes_max].real_id.load();
}

bool is_caught(const posix::Record& record, int signal) {
  return (family_of(record).processes[0].caught >> (signal - 1) & 1) != 0;
}

RunCounts counts_in(const posix::Record& record) {
  const Family& family = family_of(record);
  return {.processes = std::max<std::uint64_t>(1, family.made),
          .threads = record.threads_made + family.threads_made,
          .threads_at_once = record.threads_most,
          .events = events_of(record),
          .switches = kernel::switches(record.scheduler()) + family.hand_overs,
          .time = time_of(record)};
}

std::string counts_of(const posix::Record& record) {
  const RunCounts counts = counts_in(record);
  const std::string all = counts.processes > 1 ? fmt::format("{} processes, ", counts.processes) : "";
  return all + fmt::format("{}, {} at once, {}, {}, {} s of virtual time", counted(counts.threads, "thread"),
                           counts.threads_at_once, counted(counts.events, "event"), counted(counts.switches, "switch"),
                           to_string(counts.time));
}

void kill_all(const posix::Record& record) {
  for (const Process& process : entries_of(family_of(record)))
    if (is_in_system(process)) kill(process.real_id, SIGKILL);
}

void end_others(const posix::Record& record, const std::function<bool()>& is_to_end) {
  const Family& family = family_of(record);
  constexpr int look_ms = 1, looks_after_end = 2000;  // when the run is over each reports its threads, and ends
  const auto is_anybody_there = [&family] {
    return std::ranges::any_of(entries_of(family), [&family](const Process& process) {
      const bool takes_turns = process.state == Process::State::alive && !process.is_native;
      return &process != family.processes && takes_turns && kill(process.real_id, 0) == 0;
    });
  };
  for (int looks = 0; looks < looks_after_end && family.alive > 0 && is_anybody_there() && !is_to_end();
       poll(nullptr, 0, look_ms))
    if (family.is_over) ++looks;
  kill_all(record);
  while (waitpid(-1, nullptr, WNOHANG) > 0) {
  }
}

}  // namespace waitpoint::tools
