// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/self_check.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/exception_text.hpp"
#include "core/number_text.hpp"
#include "core/process_state.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/sync/duration_record.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/check/checked_run.hpp"
#include "tools/check/event_comparison.hpp"
#include "tools/check/event_log.hpp"
#include "tools/check/perturbed_memory.hpp"
#include "tools/check/perturbed_process.hpp"
#include "tools/check/system_threads.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr Duration window = std::chrono::milliseconds(100);
constexpr int status_interrupted = 130;
constexpr const char* durations_name = "durations of the first run";

/// The result of a run, complete or up to its first difference.
struct Carried {
  Digest digest;
  std::string end;
  std::uint64_t events = 0;
  double wall_s = 0;
};

std::string text_of(RunEnd end) {
  switch (end) {
    case RunEnd::time_reached: return "its time is reached";
    case RunEnd::ended: return "no task remains";
    case RunEnd::deadlock: return "deadlock";
    case RunEnd::no_progress: return "no progress";
  }
  return "";
}

using Json = nlohmann::ordered_json;

std::string line(const char* name, const std::string& text) { return fmt::format("  {:<18}{}\n", name, text); }

/// Wall clock limit of the perturbed process; generous, as its shuffled heap is slower and the machine may be loaded.
double limit_s(double run_s) {
  const char* const given = std::getenv("WAITPOINT_TIME_LIMIT");
  double limit = 0;
  if (given == nullptr || *given == '\0') return 60 + 10 * run_s;
  if (!parse_number(given, limit) || !(limit > 0 && limit <= 1e9))
    throw BadInput("WAITPOINT_TIME_LIMIT", std::string("expected a positive number of seconds, found '") + given + "'");
  return limit;
}

/// The descriptor of a memory file; -1 for an empty text.
int file_of(const std::string& text) {
  if (text.empty()) return -1;
  const int file = memfd_create("waitpoint-durations", MFD_CLOEXEC);
  const bool written = file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (!written) throw BadInput("--verify", "cannot keep the durations of the first run in memory");
  return file;
}

std::string contents(int file) {
  std::string text;
  char part[4096];
  for (ssize_t got = 0; (got = pread(file, part, sizeof part, static_cast<off_t>(text.size()))) > 0;)
    text.append(part, static_cast<std::size_t>(got));
  return text;
}

class SelfCheck {
 public:
  SelfCheck(const CheckSubject& subject, bool (*interrupted)()) : subject_(subject), interrupted_(interrupted) {}

  int all();
  int perturbed(const PerturbedFiles& files);

 private:
  Carried first(EventLog& log);
  Carried compared(EventComparison& comparison);
  Carried carry_out(CheckedRun& checked, const EventComparison* comparison);
  int tell(const std::optional<Difference>& difference, const std::string& run) const;
  int tell_same(const Carried& run, const SharedPage& seen) const;
  int tell_verdict(int status, const std::string& text, Json json) const;

  const CheckSubject& subject_;
  bool (*interrupted_)();
  SystemThreads threads_;
  DurationRecord durations_;  // of the first run
};

Carried SelfCheck::carry_out(CheckedRun& checked, const EventComparison* comparison) {
  const double start_s = wall_clock_s();
  const CodelsChecked codels;
  Carried run;
  try {
    RunEnd end = RunEnd::time_reached;
    for (Time reached; end == RunEnd::time_reached && reached < subject_.until && !interrupted_();) {
      reached = std::min(subject_.until, reached + window);
      end = checked.run_before(reached);
      threads_.look();
      if (comparison != nullptr && comparison->parted()) break;
    }
    run.end = text_of(end);
  } catch (const std::exception& error) {
    const bool is_first = comparison == nullptr;
    if (is_first && dynamic_cast<const BadInput*>(&error) != nullptr) throw;  // as in a run without a check
    run.end = std::string("it failed: ") + exception_text(error);
  }
  run.digest = checked.simulation().digest();
  run.events = kernel::events(checked.simulation().scheduler());
  run.wall_s = wall_clock_s() - start_s;
  return run;
}

Carried SelfCheck::first(EventLog& log) {
  const std::unique_ptr<CheckedRun> checked = subject_.make();
  std::optional<DurationRecorder> recorder;
  if (!subject_.replays_durations) recorder.emplace(checked->simulation(), durations_name);
  log.watch(checked->simulation());
  Carried run = carry_out(*checked, nullptr);
  if (recorder) durations_ = recorder->record();
  log.finish(run.digest, run.end);
  return run;
}

Carried SelfCheck::compared(EventComparison& comparison) {
  const std::unique_ptr<CheckedRun> checked = subject_.make();
  std::optional<DurationReplay> replay;
  if (!durations_.entries.empty()) replay.emplace(checked->simulation(), durations_, durations_name, durations_name);
  comparison.watch(checked->simulation());
  return carry_out(*checked, &comparison);
}

/// The text's last lines and the document's last keys are those of both verdicts.
int SelfCheck::tell_verdict(int status, const std::string& text, Json json) const {
  write_text(text, subject_.json);
  if (!subject_.json) return status;
  json["os_threads"] = threads_.found();
  json["replay"] = subject_.command;
  return end_with_json(subject_.of, status, json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

int SelfCheck::tell(const std::optional<Difference>& difference, const std::string& run) const {
  if (!difference) return 0;
  std::string text = fmt::format("{}, seed {}: not the same run: {} differs from the first\n{}", subject_.name,
                                 subject_.seed, run, to_text(*difference));
  for (const std::string& thread : threads_.found())
    text += line("OS thread", thread + " was started during the run and is not repeatable");
  text += line("replay", subject_.command);
  Json json{{"checked", subject_.name}, {"seed", subject_.seed}, {"same", false}, {"differing_run", run}};
  json["difference"] = Json::parse(to_json(*difference));
  return tell_verdict(1, text, std::move(json));
}

int SelfCheck::tell_same(const Carried& run, const SharedPage& seen) const {
  std::string text = fmt::format("{}, seed {}: the same run, twice in this process and once in a perturbed one\n",
                                 subject_.name, subject_.seed);
  Json json{{"checked", subject_.name},
            {"seed", subject_.seed},
            {"same", true},
            {"events", run.events},
            {"digest", to_string(run.digest)},
            {"end", run.end},
            {"durations_replayed", durations_.entries.size()},
            {"not_perturbed", Json::array()}};
  text += line("events", fmt::format("{}, each compared with its robot's digest", run.events));
  text += line("digest", to_string(run.digest));
  if (run.end.starts_with("it failed")) text += line("ended", run.end);
  if (!durations_.entries.empty())
    text += line("durations", fmt::format("{} of the first run replayed in the others", durations_.entries.size()));
  for (const std::string& thread : threads_.found())
    text += line("OS thread", thread + " was started during the run and is not repeatable");
  const auto not_perturbed = [&](const char* what) {
    text += line("not perturbed", what);
    json["not_perturbed"].push_back(what);
  };
  if (!seen.moved) not_perturbed("addresses: the kernel's layout equals this process's");
  if (!seen.surrounded) not_perturbed("clocks, directories, heap: LD_PRELOAD has no effect on this program");
  return tell_verdict(0, text, std::move(json));
}

int SelfCheck::perturbed(const PerturbedFiles& files) {
  SharedMapping shared(files.log);
  compare_surroundings(*shared.operator->());
  if (files.durations >= 0) durations_ = parse_duration_record(durations_name, contents(files.durations));
  perturb_surroundings();
  EventComparison comparison(files.log, fill_stack);
  const Carried run = compared(comparison);
  if (interrupted_()) return status_interrupted;
  return tell(comparison.finish(run.digest, run.end), "the run in a perturbed process");
}

int SelfCheck::all() {
  check_perturbed_process_possible();
  limit_s(0);  // bad input before anything is run
  sync::tell_threads_outside();
  EventLog log;
  const Carried one = first(log);
  if (interrupted_()) return status_interrupted;
  EventComparison comparison(log.file());
  const Carried two = compared(comparison);
  if (interrupted_()) return status_interrupted;
  if (const int status = tell(comparison.finish(two.digest, two.end), "the second run in this process"); status != 0)
    return status;

  SharedMapping shared(log.file());
  note_surroundings(*shared.operator->());
  shared->equal = 0;
  const int durations = file_of(durations_.entries.empty() ? "" : to_text(durations_));
  const ProcessEnd end =
      run_perturbed_process({log.file(), durations}, limit_s(std::max(one.wall_s, two.wall_s)), interrupted_);
  if (durations >= 0) close(durations);
  if (interrupted_()) return status_interrupted;
  const int status = end.status.value_or(-1);
  if (status == 1 || status == status_interrupted) return status;  // already reported
  if (status == 0) return tell_same(one, *shared.operator->());
  const std::string how = end.status ? fmt::format("ended with status {}", *end.status) : end.cut_off;
  return tell(cut_off(log.file(), shared->equal, "the process " + how), "the run in a perturbed process");
}

bool is_interrupted() { return interruption() != 0; }

int checked(const CheckSubject& subject) {
  SelfCheck check(subject, is_interrupted);
  const std::optional<PerturbedFiles> files = files_of_perturbed_process();
  if (!files) return check.all();
  struct Call {
    SelfCheck& check;
    const PerturbedFiles& files;
    int status = 0;
  } call{check, *files};
  with_perturbed_stack(
      [](void* argument) {
        Call& made = *static_cast<Call*>(argument);
        made.status = made.check.perturbed(made.files);
      },
      &call);
  return call.status;
}

}  // namespace

int self_check(const RunOptions& options, std::span<const genom::ModuleType> types) {
  const scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments, options.allowed);
  if (scenario.has_nodes()) throw BadInput("--verify", "cannot be used for a scenario with nodes");
  begin_with_program_layer(scenario);
  heed_signals();
  CheckSubject subject = subject_of(options, scenario, types);
  subject.json = options.json;
  return checked(subject);
}

int self_check(const ReplayOptions& options, std::span<const genom::ModuleType> types) {
  heed_signals();
  CheckSubject subject = subject_of(log_source(options.source), options.play, options.command, types);
  subject.of = "play";
  subject.json = options.play.json;
  return checked(subject);
}

}  // namespace waitpoint::tools
