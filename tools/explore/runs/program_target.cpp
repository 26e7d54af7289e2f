// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/program_target.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <utility>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "tools/exec/access_instructions.hpp"
#include "tools/exec/accounts.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/program_run.hpp"
#include "tools/exec/watchdog.hpp"
#include "tools/explore/runs/learned_code.hpp"
#include "tools/explore/runs/program_finding.hpp"
#include "tools/explore/runs/switch_points.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr int look_around_ms = 100;
constexpr std::size_t output_shown = 2000;

// The process of one run is asked to end by SIGTERM: see Children.
volatile std::sig_atomic_t is_to_stop = 0;
void note_stop(int) { is_to_stop = 1; }

// Standard input of the runs, each from the beginning: this process's own if it is a regular file, else empty.
int open_input() {
  struct stat of {};
  const bool is_file = fstat(STDIN_FILENO, &of) == 0 && S_ISREG(of.st_mode);
  return is_file ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3) : open("/dev/null", O_RDONLY | O_CLOEXEC);
}

int opened_again(int descriptor) {
  return open(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), O_RDONLY | O_CLOEXEC);
}

// The last lines, indented.
std::string end_of(int output) {
  const off_t size = lseek(output, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(output_shown));
  std::string text(static_cast<std::size_t>(size - from), '\0');
  const ssize_t got = pread(output, text.data(), text.size(), from);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  if (from > 0) text.erase(0, text.find('\n') + 1);
  while (text.ends_with('\n')) text.pop_back();
  std::string indented = from > 0 ? "  ..." : "";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find('\n', at));
    indented += (indented.empty() ? "  " : "\n  ") + text.substr(at, end - at);
    at = end + 1;
  }
  return indented;
}

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
  digest.add(options.seed);
  if (options.until) digest.add(static_cast<std::uint64_t>(options.until->ns()));
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

}  // namespace

ProgramTarget::ProgramTarget(const ExploreOptions& options)
    : options_(options),
      calls_(ProgramFiles(options.program)),
      fingerprint_(fingerprint_of(calls_.files, options)),
      given_input_(open_input()),
      snapshots_(options.snapshots, options.strategy) {
  options.conditions.check(calls_.files.named());
  check_snapshots(options, calls_.files);
  check_memory(options, calls_.files);
  if (options.races == Races::ignore) ignore_races();
}

ProgramTarget::~ProgramTarget() {
  close(given_input_);
  for (const Runs* runs : {&calls_, accesses_ ? &*accesses_ : nullptr})
    for (const int each : {runs != nullptr ? runs->input : -1, runs != nullptr ? runs->output : -1})
      if (each >= 0) close(each);
}

void ProgramTarget::prepare() {
  if (options_.switch_at == SwitchAt::accesses && !has_disassembler()) (void)access_instructions({});  // refuses
  const ForkServer server(calls_.files, settings_of(options_));
}

Finding ProgramTarget::run(const Plan& plan, const Request& request) {
  const SwitchAt at = fixed_switch_at().value_or(switch_points_of(plan, options_));
  return at == SwitchAt::calls || calls_.files.instrumented ? run_at_calls(plan, request)
                                                            : run_at_accesses(plan, request);
}

Finding ProgramTarget::run_at_calls(const Plan& plan, const Request& request) {
  const bool learns = request.profile && calls_.files.instrumented;
  exploration::Profile learned;
  // The default order's profile is taken with the switch points that all runs have.
  if (learns)
    learned.code = learn_code(calls_.files, [&](const Plan& learning, const std::vector<std::uint64_t>& code) {
      learned.code = code;
      return run_once(calls_, learning, {.learn = true}, learned);
    });
  Finding finding = run_once(calls_, plan, request, learns ? learned : profile_of_calls());
  if (request.profile) finding.profile.code = learned.code;
  if (!calls_.files.instrumented) finding.switch_at = SwitchAt::calls;
  return finding;
}

// A run that would be disturbed by breakpoints is made again without, so that a correct program does not fail.
Finding ProgramTarget::run_at_accesses(const Plan& plan, const Request& request) {
  posix::AccessObstacle obstacle = prepare_accesses();
  if (obstacle == posix::AccessObstacle::none) {
    const exploration::Profile& known = *accesses_->profile;
    Finding finding = run_once(*accesses_, plan, request, known);
    finding.switch_at = SwitchAt::accesses;
    // Of other instructions than the learned ones nothing is known.
    if (request.choices) finding.has_unlearned_code = true;
    if (request.profile) finding.profile.code = known.code;
    if (!request.profile && !finding.passed()) finding.profile = known;
    if (finding.obstacle == posix::AccessObstacle::none || is_to_stop != 0) return finding;
    obstacle = finding.obstacle;
    if (obstacle == posix::AccessObstacle::endless) obstacle_ = obstacle;  // the next could take as long
  }
  Finding finding = run_at_calls(plan, request);
  finding.obstacle = obstacle;
  return finding;
}

// Runs at calls and at accesses have different profiles; the search's own is of what its options ask for.
const exploration::Profile& ProgramTarget::profile_of_calls() {
  const bool is_given =
      calls_.files.instrumented || fixed_switch_at().value_or(options_.switch_at) != SwitchAt::accesses;
  if (is_given || !needs_profile(options_.strategy)) return profile_;
  if (!calls_.profile) {
    calls_.profile.emplace();
    calls_.profile = run_once(calls_, {.drawn = false}, {.profile = true}, *calls_.profile).profile;
  }
  return *calls_.profile;
}

// Once for each process that makes runs: all learn the same.
posix::AccessObstacle ProgramTarget::prepare_accesses() {
  if (!obstacle_) obstacle_ = learn_accesses();
  return *obstacle_;
}

posix::AccessObstacle ProgramTarget::learn_accesses() {
  using posix::AccessObstacle;
  if (!has_disassembler()) return AccessObstacle::no_disassembler;
  accesses_.emplace(ProgramFiles(options_.program, false, SwitchAt::accesses));
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
    obstacle = finding.obstacle;
    has_failed = has_failed || !finding.passed();
    return finding;
  });
  if (obstacle != AccessObstacle::none) return obstacle;
  if (profile.code.empty()) return has_failed ? AccessObstacle::unlearned : AccessObstacle::nothing_shared;
  if (!needs_profile(options_.strategy)) return obstacle;
  const Finding usual = run_once(*accesses_, {.drawn = false}, {.profile = true}, profile);
  const std::vector<std::uint64_t> code = std::move(profile.code);
  profile = usual.profile;
  profile.code = code;
  return usual.obstacle;
}

// Looking up source lines takes a second: a process tells of each race once, in the first run that shows it.
bool ProgramTarget::shows_new_races(const Finding& finding) {
  const std::size_t before = told_.size();
  told_.insert(finding.racing.begin(), finding.racing.end());
  return told_.size() > before;
}

// A process that makes another run has those of the last one.
void ProgramTarget::open_streams(Runs& runs) const {
  if (runs.server->is_rerun()) {
    lseek(runs.input, 0, SEEK_SET);
    if (lseek(runs.output, 0, SEEK_END) > 0 && ftruncate(runs.output, 0) == 0) lseek(runs.output, 0, SEEK_SET);
    return;
  }
  for (const int each : {runs.input, runs.output})
    if (each >= 0) close(each);
  runs.input = opened_again(given_input_);
  runs.output = memfd_create("waitpoint-output", MFD_CLOEXEC);
}

Finding ProgramTarget::run_once(Runs& runs, const Plan& plan, const Request& request,
                                const exploration::Profile& profile) {
  posix::Settings settings = settings_of(options_);
  if (!runs.server) {
    // A process has one memory of runs.
    calls_.server.reset();
    if (accesses_) accesses_->server.reset();
    std::signal(SIGTERM, note_stop);
    runs.server.emplace(runs.files, settings);
  }
  if (options_.snapshots > 0) settings.makes_reruns = false;
  Finding finding = run_in_process(runs, settings, plan, request, profile, true);
  if (!runs.server->is_followed() || finding.kind <= Finding::Kind::misuse || is_to_stop != 0 ||
      finding.obstacle != posix::AccessObstacle::none)
    return finding;
  // A failure is reported as it happens in a process of its own, whose calls are not trapped.
  runs.server->fork_next();
  settings.makes_reruns = false;
  return run_in_process(runs, settings, plan, request, profile, false);
}

// In a snapshot, if one is on the way.
RunMemory& ProgramTarget::begin_run(Runs& runs, const posix::Settings& settings, const Plan& plan,
                                    const Request& request, bool makes_snapshots) {
  for (;;) {
    const Snapshot* const begin = snapshots_.best_for(plan, request);
    const SnapshotsAsked asked = makes_snapshots ? snapshots_.to_make(plan, request) : SnapshotsAsked();
    if (begin == nullptr) return runs.server->begin(settings, asked);
    if (RunMemory* const memory = runs.server->begin_in(*begin, settings, asked)) return *memory;
    snapshots_.drop(*begin);
  }
}

Finding ProgramTarget::run_in_process(Runs& runs, const posix::Settings& settings, const Plan& plan,
                                      const Request& request, const exploration::Profile& profile,
                                      bool makes_snapshots) {
  RunMemory& memory = begin_run(runs, settings, plan, request, makes_snapshots);
  ask_for_run(memory, runs.files, options_, plan, request, profile);
  open_streams(runs);
  const pid_t process = runs.server->start(runs.input, runs.output);
  Watchdog watchdog(memory.record());
  const double start_s = wall_clock_s();
  std::uint64_t events = 0;
  bool has_gone_on = true;  // since the last look
  std::string stalled;
  std::optional<int> status;
  // The limit is not known yet where code is learned, and only the default order may be assumed to end.
  const double limit = limit_s() <= 0 && request.learn && plan.at_random_from ? least_limit_s : limit_s();
  const auto is_stalled = [&] {
    const bool is_over = limit > 0 && wall_clock_s() - start_s >= limit;
    if (is_to_stop != 0 || is_over)
      stalled = (is_over ? over_limit(limit) : "stopped by a signal") + " at " + to_string(time_of(memory.record())) +
                " s of virtual time\n" + states_of(memory.record());
    else if (std::string words = watchdog.look(); !words.empty())
      stalled = std::move(words);
    else
      has_gone_on = events_of(memory.record()) != std::exchange(events, events_of(memory.record()));
    return !stalled.empty();
  };
  while (!(status = runs.server->wait(look_around_ms)))
    if (stalled.empty() && is_stalled()) kill(process, SIGKILL);
  // Those left behind take part in the run, up to its end.
  double looked_s = wall_clock_s();
  const auto is_stalled_by_now = [&] {
    if (wall_clock_s() - looked_s < look_around_ms / 1000.0) return false;
    looked_s = wall_clock_s();
    return is_stalled();
  };
  if (stalled.empty() && !request.stop_before) end_others(memory.record(), is_stalled_by_now);
  Finding finding =
      finding_of_run(memory, *status, end_of(runs.output), request, options_.trace.has_value(), races_fail());
  if (options_.races == Races::report && !request.learn && !request.places && shows_new_races(finding))
    tell_races(memory.record(), finding);
  if (!stalled.empty()) {
    while (stalled.ends_with('\n')) stalled.pop_back();
    finding.kind = Finding::Kind::no_progress;
    finding.words = stalled;
    if (has_gone_on) finding.digest = 0;  // how far it came is the wall clock's
    if (!runs.files.accesses.empty()) finding.obstacle = posix::AccessObstacle::endless;
  }
  if (memory.record().explored != nullptr)
    snapshots_.add(runs.server->take_snapshots(), plan, schedule_of(memory.record()));
  runs.server->end();
  return finding;
}

}  // namespace waitpoint::tools
