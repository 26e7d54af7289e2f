// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/recorded_runs.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/error.hpp"
#include "tests/fibers/explore/completeness/comparison.hpp"

namespace waitpoint::completeness {
namespace {

// As in program.c.
constexpr std::size_t reads_max = 12, page = 4096;
struct Record {
  int ending;
  int by;
  int values[objects];
  int owners[objects];
  struct {
    int is_created, has_ended;
    int step, object;
    int count, reads[reads_max];
  } threads[threads_max];
};
static_assert(sizeof(Record) <= page);

// The threads of a cycle through `thread`; empty if there is none. A record does not say whether a waiter on a
// condition has been woken, and waits for the mutex: if `are_woken`, all do.
std::vector<std::size_t> cycle_from(const Record& record, std::size_t thread, bool are_woken = false) {
  std::vector<std::size_t> cycle;
  for (std::size_t member = thread; cycle.size() <= threads_max;) {
    cycle.push_back(member);
    const auto& waiter = record.threads[member];
    const bool is_at_lock = waiter.step == 'l' || (are_woken && waiter.step == 'w');
    const bool locks = is_at_lock && record.owners[waiter.object] != 0;
    if (waiter.has_ended != 0 || (!locks && waiter.step != 'j')) break;
    member = static_cast<std::size_t>(locks ? record.owners[waiter.object] - 1 : waiter.object);
    if (member != thread) continue;
    std::sort(cycle.begin(), cycle.end());
    return cycle;
  }
  return {};
}

// The outcome, or the two that it may be. `all`: those that are possible.
Outcomes outcomes_of(const Record& record, std::size_t threads, const Outcomes& all) {
  Observed observed;
  std::vector<std::size_t> stuck;
  for (std::size_t t = 0; t < threads; ++t) {
    const auto& thread = record.threads[t];
    observed.reads.emplace_back(thread.reads, thread.reads + thread.count);
    if (thread.is_created != 0 && thread.has_ended == 0) stuck.push_back(t);
  }
  observed.values.assign(std::begin(record.values), std::end(record.values));
  const auto by = static_cast<std::size_t>(record.by);
  if (record.ending == 'k') return {outcome("exit", {by}, observed)};
  if (record.ending == 'm') return {outcome("misuse", {by}, observed)};
  if (record.ending == 'd') return {outcome(stuck.empty() ? "ended" : "ended too early", stuck, observed)};
  for (std::size_t t = 0; t < threads; ++t)
    if (const std::vector<std::size_t> cycle = cycle_from(record, t); !cycle.empty())
      return {outcome("cycle", cycle, observed)};
  const std::string whole = outcome("stuck", stuck, observed);
  const bool may_be_cycle =
      std::any_of(all.begin(), all.end(), [](const auto& one) { return one.starts_with("cycle"); });
  if (all.count(whole) == 0 && may_be_cycle) return {"cycle ?"};
  Outcomes either{whole};
  for (std::size_t t = 0; t < threads; ++t)
    if (const std::vector<std::size_t> cycle = cycle_from(record, t, true); !cycle.empty())
      if (const std::string other = outcome("cycle", cycle, observed); all.count(other) != 0) either.insert(other);
  return either;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The line of each schedule in the file of results.
std::vector<std::string> lines_of(const std::string& results) {
  std::vector<std::string> all;
  std::istringstream lines(results);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) all.push_back(line);
  return all;
}

}  // namespace

Covered cover_by_exec(const ExecTools& tools, const Program& program, const std::string& strategy,
                      std::uint64_t schedules_max) {
  const std::string runs = tools.folder + "/runs", results = tools.folder + "/results", told = tools.folder + "/told";
  for (const std::string& file : {runs, results, told}) (void)std::remove(file.c_str());
  // Each schedule is one run: in a process that is put back, a failing one would be run again.
  const std::string command = "'" + tools.waitpoint + "' explore --fork-each --no-minimize --observe 0 --strategy " +
                              strategy + " --iterations " + std::to_string(schedules_max) + " --results '" + results +
                              "' -- '" + tools.interpreter + "' '" + to_text(program) + "' '" + runs + "' > '" + told +
                              "' 2>&1";
  const int status = std::system(command.c_str());
  const std::string said = text_of(told), records = text_of(runs);
  if (records.empty() || records.size() % page != 0) throw BadInput(command, "expected runs, found: " + said);
  Covered covered;
  covered.is_finished = said.find("exhaustive") != said.npos;
  covered.leaves_turns = said.find("turns of spinning") != said.npos;
  const Outcomes all = enumerate(program, states_max).outcomes;
  const std::vector<std::string> lines = lines_of(text_of(results));
  constexpr std::size_t before = 1;  // the default order, for the profile; after the search come those of the report
  for (std::size_t i = 0; i < records.size() / page; ++i) {
    const std::string line = i >= before && i - before < lines.size() ? lines[i - before] : "";
    if (line.find("cut short") != line.npos) continue;
    Record record;
    std::memcpy(&record, records.data() + i * page, sizeof record);
    // The thread that ends the program has said so, but its event did not come.
    if (line.find("deadlock") != line.npos) record.ending = 0;
    covered.outcomes.merge(outcomes_of(record, program.threads.size(), all));
    ++covered.schedules;
  }
  if (status != 0 && covered.outcomes.size() == 1 && covered.outcomes.begin()->starts_with("ended:"))
    covered.outcomes.insert("failed: " + said);
  return covered;
}

}  // namespace waitpoint::completeness
