// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/program_finding.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <iterator>
#include <sstream>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/strategies/dpor.hpp"
#include "fibers/explore/target/evidence_text.hpp"
#include "fibers/posix/exec/exploration.hpp"
#include "tools/command/signal_words.hpp"
#include "tools/exec/access_obstacles.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/last_calls_report.hpp"
#include "tools/exec/misuse_report.hpp"
#include "tools/exec/race_report.hpp"

namespace waitpoint::tools {
namespace {

using posix::Asked;

// Clock reads and yields that are paid for together: that many of them happen at one instant.
constexpr std::uint32_t looks_at_once = 64;
// The same for batches of 128 uses of primitives.
constexpr std::uint32_t batches_at_once = 4;

/// A copy for the program, in shared memory.
template <class T>
std::span<const T> copied(posix::Arena& arena, const std::vector<T>& values) {
  if (values.empty()) return {};
  T* const copy = static_cast<T*>(arena.take(values.size() * sizeof(T)));
  if (copy == nullptr) throw BadInput("exec", "the program's profile is too large");
  std::uninitialized_copy(values.begin(), values.end(), copy);
  return {copy, values.size()};
}

void tell_profile(posix::Arena& arena, const exploration::Profile& profile, Asked& asked) {
  std::vector<Asked::TaskProfile> tasks;
  for (const exploration::Profile::TaskEvents& task : profile.tasks)
    tasks.push_back({task.task, task.parent, task.events, copied(arena, task.objects)});
  asked.steps = profile.steps;
  asked.tasks = copied(arena, tasks);
  asked.shared = copied(arena, profile.shared);
}

/// The instructions at these places.
std::vector<posix::AccessInstruction> learned(const std::vector<posix::AccessInstruction>& all,
                                              const std::vector<std::uint64_t>& code) {
  std::vector<posix::AccessInstruction> found;
  std::vector<std::uint64_t> places = code;
  std::ranges::sort(places);
  std::ranges::copy_if(all, std::back_inserter(found), [&](const posix::AccessInstruction& one) {
    return std::ranges::binary_search(places, one.place);
  });
  return found;
}

void judge(const RunMemory& memory, int status, Finding& finding) {
  const posix::Ending ending = memory.record().ending;
  finding.kind = RunVerdict::Kind::unmet;
  if (!memory.record().began) {
    finding.words = "did not reach main()";
  } else if (ending == posix::Ending::deadlock) {
    finding.kind = RunVerdict::Kind::deadlock;
    finding.words = "deadlock";
  } else if (ending == posix::Ending::no_progress) {
    finding.kind = RunVerdict::Kind::no_progress;
    finding.words = "no progress: the threads poll without end";
  } else if (ending == posix::Ending::idle) {
    finding.kind = RunVerdict::Kind::no_progress;
    finding.words = "idle: only timers expire, and no thread wakes another";
  } else if (WIFSIGNALED(status)) {
    // An abort is how assertions fail.
    if (WTERMSIG(status) != SIGABRT) finding.kind = RunVerdict::Kind::crash;
    finding.words = "terminated by " + signal_in_words(WTERMSIG(status));
  } else if (WEXITSTATUS(status) != 0) {
    finding.words = "exit status " + std::to_string(WEXITSTATUS(status));
  } else {
    finding.kind = RunVerdict::Kind::passed;
  }
}

const posix::SharedSchedule* shared_schedule_of(const posix::Record& record) {
  return static_cast<const posix::SharedSchedule*>(common_of(record, posix::family::Part::schedule));
}

std::uint64_t hash_of(const sync::CodePlaces& calls) {
  if (calls.empty()) return 0;
  Digest digest;
  digest.add(std::string_view(calls.front().module));
  digest.add(static_cast<std::uint64_t>(calls.front().offset));
  return digest.value();
}

std::vector<exploration::RacingCode> racing_code(const posix::Record& record) {
  std::vector<exploration::RacingCode> code;
  for (const races::LocatedRace& race : located_races(record)) {
    const auto [first, second] = std::minmax({hash_of(race.first_calls), hash_of(race.second_calls)});
    code.push_back({first, second});
  }
  return code;
}

}  // namespace

posix::Settings settings_of(const ExploreOptions& options) {
  posix::Settings settings;
  settings.order = kernel::Order::explored;
  settings.seed = options.seed;
  settings.looks_at_once = looks_at_once;
  settings.batches_at_once = batches_at_once;
  settings.makes_reruns = !options.forks_each && !options.conditions.own_machine;
  if (options.has_until() && !options.has_nodes) settings.until = options.until;
  options.conditions.apply_to(settings);
  return settings;
}

void ask_for_run(RunMemory& memory, const ProgramFiles& files, const ExploreOptions& options, const Plan& plan,
                 const WantedEvidence& wanted, const exploration::Profile& profile) {
  posix::Record& record = memory.record();
  Asked& asked = *new (record.arena.take(sizeof(Asked))) Asked();
  const std::string strategy = plan.drawing_strategy(options.strategy);
  WAITPOINT_CHECK(strategy.size() < sizeof asked.strategy, "the name of a strategy is too long");
  std::memcpy(asked.strategy, strategy.c_str(), strategy.size() + 1);
  asked.seed = options.seed;
  asked.number = plan.at_random_from ? plan.attempt : plan.number;
  asked.switches = copied(record.arena, plan.switches);
  asked.deviations = copied(record.arena, plan.deviations);
  asked.constraints = copied(record.arena, plan.constraints);
  asked.progress = copied(record.arena, plan.progress);
  asked.at_random_from = plan.at_random_from.value_or(Asked::none);
  if (plan.drawn) tell_profile(record.arena, profile, asked);
  asked.code = copied(record.arena, profile.code);
  if (!files.instrumented)
    asked.accesses =
        copied(record.arena, wanted.learn || wanted.conflicts ? files.accesses : learned(files.accesses, profile.code));
  asked.libraries = copied(record.arena, files.libraries);
  asked.memory = options.memory;
  asked.learn = wanted.learn;
  asked.notes = wanted.choices;
  asked.conflicts = wanted.conflicts;
  asked.pairs = wanted.pairs;
  asked.profile = wanted.profile;
  asked.words = wanted.words;
  asked.events = wanted.events.has_value();
  if (wanted.events) asked.events_from = wanted.events->from;
  asked.decision = wanted.decision.value_or(Asked::none);
  asked.log_from = wanted.log_from.value_or(Asked::none);
  asked.stops = wanted.stop_before.has_value();
  asked.stop_before = wanted.stop_before.value_or(exploration::EventOf());
  record.settings.asked = &asked;
  record.settings.until = std::min(record.settings.until, plan.until);
}

exploration::Schedule schedule_of(const posix::Record& record) {
  const auto* const shared = shared_schedule_of(record);
  if (shared == nullptr) return record.explored->explorer.schedule();
  const auto decisions = shared->decisions.all();
  const auto switches = shared->switches.all();
  return {{decisions.begin(), decisions.end()}, {switches.begin(), switches.end()}, shared->cuts_polls_short};
}

namespace {

// In another process than the first.
bool has_parted_elsewhere(const posix::Record& record) {
  const auto* const shared = shared_schedule_of(record);
  return shared != nullptr && shared->parted;
}

}  // namespace

void tell_races(const posix::Record& record, Finding& finding) {
  for (const auto& [process, races] : races_by_process(record))
    for (const races::Race& race : races) finding.evidence.races.push_back(exploration::told(race, process));
}

Finding finding_of_run(const RunMemory& memory, int status, const std::string& output, const WantedEvidence& wanted,
                       bool races_fail) {
  Finding finding;
  judge(memory, status, finding);
  if (!finding.passed() && !output.empty()) finding.words += "\n" + output;
  const posix::Record& record = memory.record();
  finding.obstacle = obstacle_of(record);
  finding.libraries = watched_libraries_of(record);
  if (wanted.conflicts && has_lost_breakpoints(record)) finding.obstacle = AccessObstacle::long_loops;
  if (wanted.conflicts && !is_single(record)) finding.obstacle = AccessObstacle::several_processes;
  finding.racing = racing_code(record);
  finding.has_raced = !finding.racing.empty();
  if (wanted.places || wanted.conflicts) tell_races(record, finding);
  if (wanted.places && !finding.passed()) finding.evidence.details = last_calls_of(record);
  if (const std::string misuse = first_misuse(record); finding.passed() && !misuse.empty()) {
    finding.kind = RunVerdict::Kind::misuse;
    finding.words = "misuse: " + misuse;
    if (wanted.places) finding.evidence.details = misuses_of(record);
  }
  if (finding.passed() && races_fail && finding.has_raced && !wanted.conflicts) {
    finding.kind = RunVerdict::Kind::race;
    finding.words = "a data race";
    if (wanted.places) finding.evidence.details = races_of(record);
  }
  if (record.explored == nullptr) return finding;
  const posix::Explored& explored = *record.explored;
  finding.digest = digest_of(record).value();
  finding.end = time_of(record);
  finding.events = events_of(record);
  const exploration::Schedule schedule = schedule_of(record);
  finding.take(schedule, explored.explorer.parted() || has_parted_elsewhere(record));
  finding.was_cut = explored.explorer.was_cut();
  // The dependences between events of several processes are not known: no two different runs count as one.
  finding.order = is_single(record) ? explored.explorer.trace() : finding.digest;
  finding.is_beyond_enumeration = explored.explorer.is_beyond_enumeration();
  if (wanted.pairs) {
    finding.lesson.pairs = explored.relation.pairs();
    std::ranges::sort(finding.lesson.pairs);
    finding.lesson.pairs.erase(std::unique(finding.lesson.pairs.begin(), finding.lesson.pairs.end()),
                               finding.lesson.pairs.end());
  }
  if (wanted.choices) finding.lesson.choices = schedule.decisions;
  if (wanted.choices && std::string_view(record.settings.asked->strategy) == "dpor" && is_single(record))
    // The run's own process has another table of virtual functions.
    finding.lesson.progress = static_cast<const exploration::Dpor&>(*explored.strategy).progress();
  finding.has_unlearned_code = has_unlearned_code(record);
  finding.has_left_out_values = has_left_out_values(record);
  const posix::family::Family& family = family_of(record);
  finding.uses_futexes = family.uses_futexes;
  finding.meets_outside = family.meets_outside;
  finding.generated_code = family.generated_code;
  if (wanted.profile) {
    finding.lesson.profile = explored.profile;
    finding.lesson.profile.finish(explored.explorer.steps());
  }
  if (wanted.learn) {
    const std::span<const std::uint64_t> code = code_of(record);
    finding.lesson.profile.code.assign(code.begin(), code.end());
  }
  if (const posix::History* const history = history_of(record); history != nullptr) {
    tell(history->narration, wanted, finding.evidence);
    if (wanted.events) tell(history->timeline, *wanted.events, finding.evidence);
  }
  if (wanted.log_from) finding.evidence.log = explored.log;
  if (wanted.stop_before && !explored.stopped_before.empty()) {
    const sync::CodePlaces stacks[] = {explored.stopped_calls};
    tell(finding.end, explored.stopped_before, sync::user_source_lines(stacks, exploration::frames_shown).front(),
         finding.evidence);
  }
  return finding;
}

}  // namespace waitpoint::tools
