// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay/program_replay.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "fibers/explore/search/feedback.hpp"
#include "tools/exec/access_obstacles.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/program_run.hpp"
#include "tools/explore/replay/replay_json.hpp"
#include "tools/explore/replay/replay_record.hpp"
#include "tools/explore/runs/learned_code.hpp"
#include "tools/explore/runs/program_finding.hpp"
#include "tools/explore/runs/program_target.hpp"
#include "tools/explore/runs/run_streams.hpp"
#include "tools/explore/runs/run_with_nodes.hpp"
#include "tools/nodes/log_folder.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {
namespace {

/// The program with the streams of a search, whatever this process's are; and of a scenario with nodes the folder of
/// their logs.
struct ReplayedProgram {
  explicit ReplayedProgram(const ExploreOptions& options)
      : files(options.program, false, options.switch_at, options.libraries) {
    if (!options.has_nodes) return;
    around.emplace();
    logs.emplace(*around).use();
  }
  /// The output of a run that begins. Nodes' is searched for what they report.
  OutputStreams begin_run() {
    if (logs) logs->clear();
    streams.open(!logs);
    dup2(streams.input(), STDIN_FILENO);
    return {streams.output(), streams.errors()};
  }

  ProgramFiles files;
  RunStreams streams = {};
  std::optional<LogFolder> around = {}, logs = {};  // a path as long as in a search: it is in the nodes' memory
};

/// A run; the program's output is discarded.
Finding look(ReplayedProgram& replayed, const ExploreOptions& options, const Plan& plan, const WantedEvidence& wanted,
             const exploration::Profile& known) {
  RunMemory memory(settings_of(options));
  ask_for_run(memory, replayed.files, options, plan, wanted, known);
  const ProgramRun run(replayed.files, memory, replayed.begin_run(),
                       options.schedule_limit_s.value_or(ExploreOptions::usual_schedule_limit_s));
  Finding finding = finding_of_run(memory, run.status(), "", wanted, false);
  if (run.is_over_limit()) finding.kind = RunVerdict::Kind::no_progress;
  return finding;
}

void check_obstacle(const Finding& finding) {
  if (const std::string words = words_of(finding.obstacle); !words.empty())
    throw BadInput("--switch-at", words + "; expected calls");
}

/// The parts of the profile that the schedule depends on.
exploration::Profile take_profile(ReplayedProgram& replayed, const ExploreOptions& options, const Plan& plan) {
  exploration::Profile known, profile;
  known.code = learn_code(replayed.files, [&](const Plan& learning, const std::vector<std::uint64_t>& code) {
    known.code = code;
    Finding finding = look(replayed, options, learning, {.learn = true}, known);
    check_obstacle(finding);
    return finding;
  });
  if (plan.drawn && needs_profile(options.strategy))
    profile = look(replayed, options, {.drawn = false}, {.profile = true}, known).lesson.profile;
  profile.code = known.code;
  return profile;
}

/// The run of the record, up to the start of its process.
struct Replay {
  explicit Replay(const ExploreOptions& asked);

  ExploreOptions options;
  ReplayRecord record;
  std::optional<ReplayedProgram> replayed;
  WantedEvidence wanted;
  std::optional<RunMemory> memory;
};

Replay::Replay(const ExploreOptions& asked) : options(asked) {
  const ProgramFiles named(options.program);
  options.conditions.check(named.named());
  record = read_replay_record(options, fingerprint_of(named, options));
  check_memory(options, named);
  replayed.emplace(options);
  const exploration::Profile profile = take_profile(*replayed, options, record.plan);
  const auto learn_from = [&](const Plan& plan) { return look(*replayed, options, plan, {.pairs = true}, profile); };
  const Plan plan = record.plan.drawn
                        ? exploration::Feedback(options.strategy, options.seed).plan_of(record.plan.number, learn_from)
                        : record.plan;
  wanted = {.words = !record.plan.drawn, .places = true};
  if (options.trace) wanted.events = {.trace = true};
  ask_for_run(memory.emplace(settings_of(options)), replayed->files, options, plan, wanted, profile);
}

}  // namespace

void replay_in(const ExploreOptions& options, const Start& start) {
  const int own_input = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  Replay replay(options);
  replay.replayed->begin_run();
  dup2(own_input, STDIN_FILENO);
  start(replay.replayed->files, *replay.memory, replay.replayed->streams.input());
}

int replay_program(const ExploreOptions& asked) {
  std::optional<OutputFile> trace;
  if (asked.trace) trace.emplace(*asked.trace);
  Replay replay(asked);
  const ExploreOptions& options = replay.options;
  const ReplayRecord& record = replay.record;
  const WantedEvidence& wanted = replay.wanted;
  ReplayedProgram& replayed = *replay.replayed;
  RunMemory& memory = *replay.memory;
  const double limit_s = options.schedule_limit_s.value_or(ExploreOptions::usual_schedule_limit_s);
  // Shown while the program writes it; it would be in the way of a document.
  const auto show = [&] {
    if (RunStreams::are_shown()) write_text(replayed.streams.new_output(), options.json);
    std::fputs(replayed.streams.new_errors().c_str(), stderr);
  };
  const ProgramRun run(replayed.files, memory, replayed.begin_run(), limit_s, show);
  show();
  const std::string output = options.has_nodes ? replayed.streams.whole_output() : "";
  Finding finding = finding_of_run(memory, run.status(), output, wanted, options.races != Races::ignore);
  if (options.has_nodes) tell_unmet(finding);
  if (options.has_nodes) finding.words = finding.headline();
  if (run.is_over_limit()) {
    finding.kind = RunVerdict::Kind::no_progress;
    finding.words = over_limit(limit_s);
  }
  check_obstacle(finding);
  if (memory.record().explored == nullptr) throw BadInput("exec", "the program ended before main()");
  const posix::History* const history = history_of(memory.record());
  const std::vector<exploration::Told> told =
      history != nullptr ? history->narration.switches : std::vector<exploration::Told>();
  check_is_run_of(record, {schedule_of(memory.record()), told, finding}, options.replay);
  if (trace) {
    trace->write(finding.evidence.trace);
    trace->commit();
  }
  std::fprintf(stderr, "waitpoint: %s%s\n", finding.passed() ? "passed" : "failed: ", finding.words.c_str());
  std::fputs(finding.evidence.details.c_str(), stderr);
  if (record.digest_bits > 0) std::fprintf(stderr, "waitpoint: the same run as in the record\n");
  const int status = finding.passed() ? 0 : 1;
  return options.json ? end_with_json("explore", status, replay_json(options, record, finding, "")) : status;
}

}  // namespace waitpoint::tools
