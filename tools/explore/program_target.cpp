// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/program_target.hpp"

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
#include "tools/exec/accounts.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/program_run.hpp"
#include "tools/exec/watchdog.hpp"
#include "tools/explore/learned_code.hpp"
#include "tools/explore/program_finding.hpp"
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

ProgramTarget::ProgramTarget(const ExploreOptions& options)
    : options_(options),
      files_(options.program, false, options.switch_at),
      fingerprint_(fingerprint_of(files_, options)),
      given_input_(open_input()) {
  options.conditions.check(files_.named());
  check_memory(options, files_);
  if (options.races == Races::ignore) ignore_races();
}

ProgramTarget::~ProgramTarget() {
  close(given_input_);
  close_streams();
}

void ProgramTarget::close_streams() const {
  for (const int each : {input_, output_})
    if (each >= 0) close(each);
}

void ProgramTarget::prepare() { const ForkServer server(files_, settings_of(options_)); }

// The default order's profile is taken with the switch points that all runs have.
Finding ProgramTarget::run(const Plan& plan, const Request& request) {
  if (!request.profile || !files_.watches_accesses()) return run_once(plan, request);
  profile_.code = learn_code(files_, [&](const Plan& learning, const std::vector<std::uint64_t>& code) {
    profile_.code = code;
    return run_once(learning, {.learn = true});
  });
  Finding finding = run_once(plan, request);
  finding.profile.code = profile_.code;
  return finding;
}

// Looking up source lines takes a second: a process tells of each race once, in the first run that shows it.
bool ProgramTarget::shows_new_races(const Finding& finding) {
  const std::size_t before = told_.size();
  told_.insert(finding.racing.begin(), finding.racing.end());
  return told_.size() > before;
}

// A process that makes another run has those of the last one.
void ProgramTarget::open_streams() {
  if (server_->is_rerun()) {
    lseek(input_, 0, SEEK_SET);
    if (lseek(output_, 0, SEEK_END) > 0 && ftruncate(output_, 0) == 0) lseek(output_, 0, SEEK_SET);
    return;
  }
  close_streams();
  input_ = opened_again(given_input_);
  output_ = memfd_create("waitpoint-output", MFD_CLOEXEC);
}

Finding ProgramTarget::run_once(const Plan& plan, const Request& request) {
  const posix::Settings settings = settings_of(options_);
  if (!server_) {
    std::signal(SIGTERM, note_stop);
    server_.emplace(files_, settings);
  }
  Finding finding = run_in_process(settings, plan, request);
  if (!server_->is_followed() || finding.kind <= Finding::Kind::misuse || is_to_stop != 0) return finding;
  // A failure is reported as it happens in a process of its own, whose calls are not trapped.
  server_->fork_next();
  posix::Settings plain = settings;
  plain.makes_reruns = false;
  return run_in_process(plain, plan, request);
}

Finding ProgramTarget::run_in_process(const posix::Settings& settings, const Plan& plan, const Request& request) {
  RunMemory& memory = server_->begin(settings);
  ask_for_run(memory, files_, options_, plan, request, profile_);
  open_streams();
  const pid_t process = server_->start(input_, output_);
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
  while (!(status = server_->wait(look_around_ms)))
    if (stalled.empty() && is_stalled()) kill(process, SIGKILL);
  // Those left behind take part in the run, up to its end.
  double looked_s = wall_clock_s();
  const auto is_stalled_by_now = [&] {
    if (wall_clock_s() - looked_s < look_around_ms / 1000.0) return false;
    looked_s = wall_clock_s();
    return is_stalled();
  };
  if (stalled.empty() && !request.stop_before) end_others(memory.record(), is_stalled_by_now);
  Finding finding = finding_of_run(memory, *status, end_of(output_), request, options_.trace.has_value(), races_fail());
  // Of other instructions than the learned ones nothing is known.
  if (request.choices && !files_.accesses.empty()) finding.has_unlearned_code = true;
  if (options_.races == Races::report && !request.learn && !request.places && shows_new_races(finding))
    tell_races(memory.record(), finding);
  if (!stalled.empty()) {
    while (stalled.ends_with('\n')) stalled.pop_back();
    finding.kind = Finding::Kind::no_progress;
    finding.words = stalled;
    if (has_gone_on) finding.digest = 0;  // how far it came is the wall clock's
  }
  server_->end();
  return finding;
}

}  // namespace waitpoint::tools
