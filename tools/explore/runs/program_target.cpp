// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/program_target.hpp"

#include <csignal>
#include <fstream>
#include <utility>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "tools/exec/access_instructions.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/explore/runs/learned_code.hpp"
#include "tools/explore/runs/program_finding.hpp"
#include "tools/explore/runs/run_watch.hpp"
#include "tools/explore/runs/run_with_nodes.hpp"
#include "tools/explore/runs/switch_points.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

// The process of one run is asked to end by SIGTERM: see Children.
volatile std::sig_atomic_t is_to_stop = 0;
void note_stop(int) { is_to_stop = 1; }

}  // namespace

std::uint64_t fingerprint_of(const ProgramFiles& files, const ExploreOptions& options) {
  Digest digest;
  for (const std::string& name : files.named()) {
    std::ifstream file(name, std::ios::binary);
    char bytes[65536];
    while (file.read(bytes, sizeof bytes) || file.gcount() > 0)
      digest.add(std::string_view(bytes, static_cast<std::size_t>(file.gcount())));
  }
  for (const std::string& word : options.program) digest.add(std::string_view(word));
  for (const std::string& library : options.libraries) digest.add(std::string_view(library));
  digest.add(options.seed);
  if (options.has_until()) digest.add(static_cast<std::uint64_t>(options.until.since_start().ns()));
  digest.add(std::string_view(options.conditions.words()));
  if (options.memory == Memory::weak) digest.add(std::string_view("weak memory"));
  return digest.value();
}

void check_memory(const ExploreOptions& options, const ProgramFiles& files) {
  if (options.memory == Memory::weak && !files.instrumented)
    throw BadInput("--memory",
                   "expected a program compiled with -fsanitize=thread, found '" + files.programs.title() + "'");
}

namespace {

void check_snapshots(const ExploreOptions& options, const ProgramFiles& files) {
  if (options.snapshots > 0 && (files.instrumented || options.switch_at == SwitchAt::accesses))
    throw BadInput("--snapshots", files.instrumented ? "expected a program without -fsanitize=thread, found '" +
                                                           files.programs.title() + "'"
                                                     : "cannot be used together with --switch-at accesses");
}

/// Of several programs, how one of them waits; they begin at calls.
Waits waits_of_all(const ProgramFiles& files) {
  if (files.instrumented) return {};
  if (!files.programs.is_session()) return waits_of(files.program, files.library);
  Waits all;
  for (const std::string& program : files.named())
    all.by_futexes = all.by_futexes || waits_of(program, files.library).by_futexes;
  return all;
}

void check_libraries(const ExploreOptions& options, const ProgramFiles& files) {
  if (options.libraries.empty()) return;
  const bool is_one = !files.instrumented && files.programs.programs().size() == 1 && !files.programs.is_session();
  if (!is_one)
    throw BadInput("--switch-at", "expected a single program without -fsanitize=thread with the libraries, found '" +
                                      files.programs.title() + "'");
  (void)watched_libraries(files.program, files.library, options.libraries);
}

}  // namespace

ProgramTarget::ProgramTarget(const ExploreOptions& options)
    : options_(options),
      calls_(ProgramFiles(options.program)),
      fingerprint_(fingerprint_of(calls_.files, options)),
      waits_(waits_of_all(calls_.files)),
      snapshots_(options.snapshots, options.strategy) {
  options.conditions.check(calls_.files.named());
  check_snapshots(options, calls_.files);
  check_memory(options, calls_.files);
  check_libraries(options, calls_.files);
  if (options.races == Races::ignore) ignore_races();
  if (options.has_nodes) logs_.emplace();
}

ProgramTarget::~ProgramTarget() = default;

exploration::TargetTraits ProgramTarget::traits() const {
  exploration::TargetTraits traits = ProcessTarget::traits();
  traits.default_fails_too = "the default order fails too, intermittently\n";
  // In the first process they are the world's, which is right.
  if (options_.has_nodes)
    traits.incomparable = "the two events whose order matters are not looked for in the processes of nodes\n";
  return traits;
}

void ProgramTarget::prepare() {
  if (options_.switch_at == SwitchAt::accesses && !has_disassembler()) (void)access_instructions({});  // refuses
  const ForkServer server(calls_.files, settings_of(options_));
}

Finding ProgramTarget::run(const Plan& plan, const WantedEvidence& wanted) {
  if (wanted.conflicts) return observe_accesses(plan);
  const SwitchAt at = fixed_switch_at().value_or(switch_points_of(plan, options_, waits_.are_at_accesses()));
  return at == SwitchAt::calls || calls_.files.instrumented ? run_at_calls(plan, wanted)
                                                            : run_at_accesses(plan, wanted);
}

// With breakpoints at all accesses.
Finding ProgramTarget::observe_accesses(const Plan& plan) {
  Finding finding;
  if (!has_disassembler()) {
    finding.obstacle = AccessObstacle::no_disassembler;
    return finding;
  }
  if (!accesses_) accesses_.emplace(ProgramFiles(options_.program, false, SwitchAt::accesses, options_.libraries));
  if (accesses_->files.accesses.empty()) {
    finding.obstacle = AccessObstacle::several_programs;
    return finding;
  }
  return run_once(*accesses_, plan, {.conflicts = true}, exploration::Profile());
}

Finding ProgramTarget::run_at_calls(const Plan& plan, const WantedEvidence& wanted) {
  const bool learns = wanted.profile && calls_.files.instrumented;
  exploration::Profile learned;
  // The default order's profile is taken with the switch points that all runs have.
  if (learns)
    learned.code = learn_code(calls_.files, [&](const Plan& learning, const std::vector<std::uint64_t>& code) {
      learned.code = code;
      return run_once(calls_, learning, {.learn = true}, learned);
    });
  Finding finding = run_once(calls_, plan, wanted, learns ? learned : profile_of_calls());
  if (wanted.profile) finding.lesson.profile.code = learned.code;
  if (!calls_.files.instrumented) finding.switch_at = SwitchAt::calls;
  finding.uses_futexes = finding.uses_futexes || waits_.by_futexes;
  return finding;
}

// A run that would be disturbed by breakpoints is made again without, so that a correct program does not fail.
Finding ProgramTarget::run_at_accesses(const Plan& plan, const WantedEvidence& wanted) {
  AccessObstacle obstacle = prepare_accesses();
  if (obstacle == AccessObstacle::none) {
    const exploration::Profile& known = *accesses_->profile;
    Finding finding = run_once(*accesses_, plan, wanted, known);
    finding.switch_at = SwitchAt::accesses;
    // Of other instructions than the learned ones nothing is known.
    if (wanted.choices) finding.has_unlearned_code = true;
    if (wanted.profile) finding.lesson.profile.code = known.code;
    if (!wanted.profile && !finding.passed()) finding.lesson.profile = known;
    if (finding.obstacle == AccessObstacle::none || is_to_stop != 0) return finding;
    obstacle = finding.obstacle;
    if (obstacle == AccessObstacle::endless) obstacle_ = obstacle;  // the next could take as long
  }
  Finding finding = run_at_calls(plan, wanted);
  finding.obstacle = obstacle;
  finding.libraries = libraries_;
  return finding;
}

// Runs at calls and at accesses have different profiles; the search's own is of what its options ask for.
const exploration::Profile& ProgramTarget::profile_of_calls() {
  const bool is_given =
      calls_.files.instrumented || fixed_switch_at().value_or(options_.switch_at) != SwitchAt::accesses;
  if (is_given || !needs_profile(options_.strategy)) return profile_;
  if (!calls_.profile) {
    calls_.profile.emplace();
    calls_.profile = run_once(calls_, {.drawn = false}, {.profile = true}, *calls_.profile).lesson.profile;
  }
  return *calls_.profile;
}

// Once for each process that makes runs: all learn the same.
AccessObstacle ProgramTarget::prepare_accesses() {
  if (!obstacle_) obstacle_ = learn_accesses();
  return *obstacle_;
}

AccessObstacle ProgramTarget::learn_accesses() {
  if (!has_disassembler()) return AccessObstacle::no_disassembler;
  accesses_.emplace(ProgramFiles(options_.program, false, SwitchAt::accesses, options_.libraries));
  if (accesses_->files.accesses.empty()) return AccessObstacle::several_programs;
  exploration::Profile& profile = accesses_->profile.emplace();
  if (fixed_switch_at().value_or(options_.switch_at) == SwitchAt::accesses && !profile_.code.empty()) {
    profile = profile_;
    return AccessObstacle::none;
  }
  AccessObstacle obstacle = AccessObstacle::none;
  bool has_failed = false;
  profile.code = learn_code(accesses_->files, [&](const Plan& learning, const std::vector<std::uint64_t>& code) {
    profile.code = code;
    Finding finding = run_once(*accesses_, learning, {.learn = true}, profile);
    libraries_ |= finding.libraries;
    obstacle = finding.obstacle;
    has_failed = has_failed || !finding.passed();
    return finding;
  });
  if (obstacle != AccessObstacle::none) return obstacle;
  if (profile.code.empty()) return has_failed ? AccessObstacle::unlearned : AccessObstacle::nothing_shared;
  if (!needs_profile(options_.strategy)) return obstacle;
  const Finding usual = run_once(*accesses_, {.drawn = false}, {.profile = true}, profile);
  const std::vector<std::uint64_t> code = std::move(profile.code);
  profile = usual.lesson.profile;
  profile.code = code;
  return usual.obstacle;
}

// Looking up source lines takes a second: a process tells of each race once, in the first run that shows it.
bool ProgramTarget::shows_new_races(const Finding& finding) {
  const std::size_t before = told_.size();
  told_.insert(finding.racing.begin(), finding.racing.end());
  return told_.size() > before;
}

Finding ProgramTarget::run_once(Runs& runs, const Plan& plan, const WantedEvidence& wanted,
                                const exploration::Profile& profile) {
  posix::Settings settings = settings_of(options_);
  if (!runs.server) {
    // A process has one memory of runs.
    calls_.server.reset();
    if (accesses_) accesses_->server.reset();
    std::signal(SIGTERM, note_stop);
    if (logs_) own_logs_.emplace(*logs_).use();
    runs.server.emplace(runs.files, settings);
  }
  if (options_.snapshots > 0) settings.makes_reruns = false;
  Finding finding = run_in_process(runs, settings, plan, wanted, profile, true);
  if (!runs.server->is_followed() || finding.kind <= RunVerdict::Kind::misuse || is_to_stop != 0 ||
      finding.obstacle != AccessObstacle::none)
    return finding;
  // A failure is reported as it happens in a process of its own, whose calls are not trapped.
  runs.server->fork_next();
  settings.makes_reruns = false;
  return run_in_process(runs, settings, plan, wanted, profile, false);
}

// In a snapshot, if one is on the way.
RunMemory& ProgramTarget::begin_run(Runs& runs, const posix::Settings& settings, const Plan& plan,
                                    const WantedEvidence& wanted, bool makes_snapshots) {
  for (;;) {
    const Snapshot* const begin = snapshots_.best_for(plan, wanted);
    const SnapshotsAsked asked = makes_snapshots ? snapshots_.to_make(plan, wanted) : SnapshotsAsked();
    if (begin == nullptr) return runs.server->begin(settings, asked);
    if (RunMemory* const memory = runs.server->begin_in(*begin, settings, asked)) return *memory;
    snapshots_.drop(*begin);
  }
}

Finding ProgramTarget::run_in_process(Runs& runs, const posix::Settings& settings, const Plan& plan,
                                      const WantedEvidence& wanted, const exploration::Profile& profile,
                                      bool makes_snapshots) {
  if (own_logs_) own_logs_->clear();
  RunMemory& memory = begin_run(runs, settings, plan, wanted, makes_snapshots);
  ask_for_run(memory, runs.files, options_, plan, wanted, profile);
  runs.server->is_rerun() ? runs.streams.rewind() : runs.streams.open();
  const pid_t process = runs.server->start(runs.streams.input(), runs.streams.output());
  // The limit is not known yet where code is learned, and only the default order may be assumed to end.
  RunWatch watch(
      memory.record(),
      limit_s() <= 0 && wanted.learn && plan.at_random_from ? ExploreOptions::usual_schedule_limit_s : limit_s(),
      patience_s(), time_limit(), is_to_stop);
  std::optional<int> status;
  while (!(status = runs.server->wait(look_around_ms)))
    if (watch.words().empty() && watch.is_to_end()) kill(process, SIGKILL);
  // Those left behind take part in the run, up to its end.
  const auto is_to_end_by_now = [&, looked_s = wall_clock_s()]() mutable {
    if (wall_clock_s() - looked_s < look_around_ms / 1000.0) return false;
    looked_s = wall_clock_s();
    return watch.is_to_end();
  };
  if (watch.words().empty() && !wanted.stop_before) end_others(memory.record(), is_to_end_by_now);
  Finding finding = finding_of_run(memory, *status, runs.streams.end_of_output(), wanted, races_fail());
  if (options_.has_nodes) tell_unmet(finding);
  if (options_.races == Races::report && !wanted.learn && !wanted.places && !wanted.conflicts &&
      shows_new_races(finding))
    tell_races(memory.record(), finding);
  if (!watch.words().empty()) {
    finding.kind = RunVerdict::Kind::no_progress;
    finding.words = watch.words();
    if (watch.has_gone_on()) finding.digest = 0;
    if (!runs.files.accesses.empty()) finding.obstacle = AccessObstacle::endless;
  }
  if (memory.record().explored != nullptr)
    snapshots_.add(runs.server->take_snapshots(), plan, schedule_of(memory.record()));
  runs.server->end();
  return finding;
}

}  // namespace waitpoint::tools
