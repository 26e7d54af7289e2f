// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <set>
#include <sstream>

#include "core/number_text.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/sync/simulation.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/command/signal_words.hpp"
#include "tools/exec/end_requests.hpp"
#include "tools/exec/exec_json.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/last_calls_report.hpp"
#include "tools/exec/misuse_report.hpp"
#include "tools/exec/program_run.hpp"
#include "tools/exec/race_report.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

std::string replay_line(const ExecOptions& options, std::uint64_t seed) {
  if (!options.replay.empty()) return options.replay;
  std::string line = "waitpoint exec --seed " + std::to_string(seed);
  if (options.order == kernel::Order::fifo) line += " --strategy fifo";
  return line + options.conditions.words() + " --" + quoted(options.words);
}

void print_summary(const posix::Record& record, const std::string& program) {
  std::fprintf(stderr, "waitpoint: %s: %s, digest %s\n", program.c_str(), counts_of(record).c_str(),
               to_string(digest_of(record)).c_str());
}

// The report of a failed run.
void print_failure(const ExecOptions& options, int signal, std::uint64_t seed) {
  if (signal != 0) std::fprintf(stderr, "waitpoint: terminated by %s\n", signal_in_words(signal).c_str());
  std::fprintf(stderr, "waitpoint: replay: %s\n", replay_line(options, seed).c_str());
}

// A program's output, kept until it is shown or dropped.
class Output {
 public:
  Output() : descriptor_(memfd_create("waitpoint-output", MFD_CLOEXEC)) {}
  ~Output() { close(descriptor_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  int descriptor() const { return descriptor_; }
  void forget() const {
    if (ftruncate(descriptor_, 0) == 0) lseek(descriptor_, 0, SEEK_SET);
  }
  void show() const {
    char bytes[65536];
    ssize_t size = 0;
    for (off_t at = 0; (size = pread(descriptor_, bytes, sizeof bytes, at)) > 0; at += size)
      std::fwrite(bytes, 1, static_cast<std::size_t>(size), stderr);
  }

 private:
  int descriptor_;
};

int run_seeds(const ExecOptions& options, const ProgramFiles& files) {
  const Output output;
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const double shown_from_s = wall_clock_s() + progress_after_s;
  std::set<std::uint64_t> digests;
  std::uint64_t runs = 0;
  for (std::uint64_t seed = options.seeds->first;; ++seed) {
    if (terminal && wall_clock_s() >= shown_from_s)
      std::fprintf(stderr, "\rseed %llu, %s ", static_cast<unsigned long long>(seed),
                   counted(digests.size(), "schedule").c_str());
    output.forget();
    const RunMemory memory(settings_of(options, seed));
    const ProgramRun run(files, memory, output.descriptor());
    if (run.is_interrupted()) end_by(run.end().signal());  // not a failure of the program
    if (const int signal = EndRequests::too_late(); signal != 0) end_by(signal);
    ++runs;
    if (memory.record().began) digests.insert(digest_of(memory.record()).value());
    if (run.end().exit_status() != 0) {
      if (terminal) std::fprintf(stderr, "\r%40s\r", "");
      output.show();
      std::fprintf(stderr, "waitpoint: seed %llu failed, after %llu that passed: exit status %d\n",
                   static_cast<unsigned long long>(seed), static_cast<unsigned long long>(runs - 1),
                   run.end().exit_status());
      print_failure(options, run.end().signal(), seed);
      if (!options.json) return 1;
      const std::string failed =
          exec_json({files.programs.title(), seed, replay_line(options, seed)}, run, memory.record());
      return end_with_json("exec", 1, seeds_json(files.programs.title(), runs, digests.size(), failed));
    }
    if (seed == options.seeds->last) break;
  }
  if (terminal) std::fprintf(stderr, "\r%40s\r", "");
  std::fprintf(stderr, "waitpoint: %s: %s, %s, none failed\n", files.programs.title().c_str(),
               counted(runs, "seed").c_str(), counted(digests.size(), "schedule").c_str());
  if (!options.json) return 0;
  return end_with_json("exec", 0, seeds_json(files.programs.title(), runs, digests.size(), ""));
}

void write_trace_of(const posix::Record& record, OutputFile& file) {
  std::ostringstream text;
  const posix::History* const history = history_of(record);
  exploration::write_trace(text, history != nullptr ? history->timeline : exploration::Timeline());
  file.write(text.str());
  file.commit();
}

}  // namespace

posix::Settings settings_of(const ExecOptions& options, std::uint64_t seed) {
  posix::Settings settings;
  settings.order = options.order;
  settings.seed = seed;
  settings.traced = options.trace.has_value();
  settings.fast_paths = are_fast_paths_enabled();
  settings.reports_ending = true;
  options.conditions.apply_to(settings);
  return settings;
}

int exec(const ExecOptions& options) {
  const ProgramFiles files(options.words, options.quiet);
  options.conditions.check(files.named());
  if (options.seeds) return run_seeds(options, files);
  std::optional<OutputFile> trace;
  if (options.trace) trace.emplace(*options.trace);
  const RunMemory memory(settings_of(options, options.seed));
  const ProgramRun run(files, memory, options.json ? STDERR_FILENO : -1);
  const bool failed = run.end().signal() != 0 || memory.record().ending != posix::Ending::own;
  if (memory.record().began) {
    std::fputs(races_of(memory.record()).c_str(), stderr);
    std::fputs(misuses_of(memory.record()).c_str(), stderr);
    if (failed) std::fputs(last_calls_of(memory.record()).c_str(), stderr);
    if (!options.quiet || failed) print_summary(memory.record(), files.programs.title());
    // Any other status is a failure only to the program's users.
    if (failed || (!options.quiet && run.end().exit_status() != 0))
      print_failure(options, run.is_interrupted() ? 0 : run.end().signal(), options.seed);
  }
  if (!memory.record().began && run.end().signal() != 0)
    std::fprintf(stderr, "waitpoint: terminated by %s before main()\n", signal_in_words(run.end().signal()).c_str());
  if (trace) write_trace_of(memory.record(), *trace);
  if (options.json)
    end_with_json(
        "exec", run.end().exit_status(),
        exec_json({files.programs.title(), options.seed, replay_line(options, options.seed)}, run, memory.record()));
  if (run.end().signal() != 0) end_by(run.end().signal());
  return run.end().exit_status();
}

}  // namespace waitpoint::tools
