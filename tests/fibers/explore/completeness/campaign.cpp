// SPDX-License-Identifier: BSD-3-Clause
// Compares the exhaustive strategies with the abstract machine on many random programs: ./dev test --completeness.
// With --estimate: compares the chance of a new pair of events as it is estimated and as it is measured.
//
//   completeness [N] [--from FIRST]    programs number FIRST to FIRST + N - 1 (default: 10000 from 1)
//   completeness --program TEXT        this one
//   ... --schedules MOST               of each program by each strategy (default: some thousand)
//   ... --strategy NAME                dfs, bounded:1000 or dpor alone (default: all three)
//   ... --exec                         on POSIX threads, under waitpoint explore, instead of in this process;
//                                      all three only for small programs
//   ... --estimate                     by samples of 25, 100 and 400 schedules, and 20 000 further ones, in this
//   process
//
// A program that differs is shrunk, and printed with the command that runs it again. Exit status: 0 no program differs,
// 1 some do, 2 bad input.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tests/fibers/explore/completeness/calibration.hpp"
#include "tests/fibers/explore/completeness/comparison.hpp"
#include "tests/fibers/explore/completeness/random_programs.hpp"
#include "tests/fibers/explore/completeness/recorded_runs.hpp"

namespace waitpoint::completeness {
namespace {

// How the programs are run.
using Cover = std::function<Covered(const Program& program, const char* strategy, std::uint64_t schedules_max)>;

struct Tally {
  const char* strategy;
  std::uint64_t schedules_max;
  std::size_t equal = 0, different = 0, left_out = 0, unfinished = 0;
  std::uint64_t schedules = 0;

  void add(RunVerdict verdict) {
    equal += verdict == RunVerdict::equal;
    different += verdict == RunVerdict::different;
    left_out += verdict == RunVerdict::left_out;
    unfinished += verdict == RunVerdict::unfinished;
  }
};

void compare_one(const Program& program, const Enumerated& all, const Cover& cover_by, Tally& tally,
                 const char* options) {
  const Coverage coverage = [&](const Program& one) { return cover_by(one, tally.strategy, tally.schedules_max); };
  const Covered covered = coverage(program);
  tally.schedules += covered.schedules;
  std::string difference;
  const RunVerdict verdict = compare(all, covered, difference);
  tally.add(verdict);
  if (verdict != RunVerdict::different) return;
  const Program least = shrink(program, coverage);
  (void)compare(enumerate(least, states_max), coverage(least), difference);
  std::printf("\n%s differs on %s\n%sagain: ./dev test --completeness%s --program '%s'\n", tally.strategy,
              to_text(program).c_str(), difference.c_str(), options, to_text(least).c_str());
  std::fflush(stdout);
}

// A folder of its own, for as long as it exists.
class Folder {
 public:
  Folder() { WAITPOINT_CHECK(mkdtemp(path_.data()) != nullptr, "no temporary folder can be made"); }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_ = std::filesystem::temp_directory_path() / "completeness-XXXXXX";
};

struct Asked {
  std::uint64_t count = 10'000, first = 1, schedules = 0;
  std::string_view program, strategy;
  bool is_exec = false, is_estimate = false;
};

std::uint64_t number(std::string_view option, std::string_view text) {
  std::uint64_t value = 0;
  if (!parse_number(text, value))
    throw BadInput(std::string(option), "expected a whole number, found '" + std::string(text) + "'");
  return value;
}

Asked read(int count, char** arguments) {
  Asked asked;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    const bool has_value =
        argument == "--from" || argument == "--program" || argument == "--schedules" || argument == "--strategy";
    if (has_value && i + 1 == count) throw BadInput(std::string(argument), "expected a value");
    if (argument == "--exec")
      asked.is_exec = true;
    else if (argument == "--estimate")
      asked.is_estimate = true;
    else if (argument == "--from")
      asked.first = number(argument, arguments[++i]);
    else if (argument == "--schedules")
      asked.schedules = number(argument, arguments[++i]);
    else if (argument == "--strategy")
      asked.strategy = arguments[++i];
    else if (argument == "--program")
      asked.program = arguments[++i];
    else
      asked.count = number("N", argument);
  }
  return asked;
}

void note_progress(std::uint64_t done, std::uint64_t all) {
  if (isatty(STDERR_FILENO) != 0)
    std::fprintf(stderr, "\r%llu of %llu programs", static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(all));
}

// Whether the interval that a search reports has the measured chance in it: in nine programs of ten at least.
int calibrate_all(const Asked& asked) {
  constexpr std::uint64_t measured = 20'000, samples[] = {25, 100, 400};
  bool is_good = true;
  for (const std::uint64_t sampled : samples) {
    std::uint64_t holding = 0, unsure = 0, unsure_holding = 0;
    double width = 0;
    for (std::uint64_t i = 0; i < asked.count; ++i) {
      const Calibration one = calibrate(make_program(asked.first + i), sampled, measured);
      holding += one.holds();
      unsure += one.share > 0;
      unsure_holding += one.share > 0 && one.holds();
      width += one.chance.upper_bound - one.chance.lower_bound;
      note_progress(i + 1, asked.count);
    }
    const auto percent = [](std::uint64_t part, std::uint64_t all) {
      return all == 0 ? 100.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
    };
    std::printf(
        "%llu schedules: the interval holds in %.1f %% of %llu programs; in %.1f %% of the %llu with a chance above 0; "
        "mean width %.3f\n",
        static_cast<unsigned long long>(sampled), percent(holding, asked.count),
        static_cast<unsigned long long>(asked.count), percent(unsure_holding, unsure),
        static_cast<unsigned long long>(unsure), width / static_cast<double>(asked.count));
    std::fflush(stdout);
    is_good = is_good && percent(holding, asked.count) >= 90;
  }
  return is_good ? 0 : 1;
}

int run(const Asked& asked) {
  if (asked.is_estimate) return calibrate_all(asked);
  const std::filesystem::path build = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
  const Folder folder;
  const ExecTools tools{build / "tools/waitpoint", build / "tests/completeness-program", folder.path()};
  const Cover cover_by = [&](const Program& program, const char* strategy, std::uint64_t most) {
    return asked.is_exec ? cover_by_exec(tools, program, strategy, most) : cover(program, strategy, most);
  };
  std::vector<Tally> tallies = asked.is_exec
                                   ? std::vector<Tally>{{"dfs", 1'000}, {"bounded:1000", 500}, {"dpor", 2'000}}
                                   : std::vector<Tally>{{"dfs", 4'000}, {"bounded:1000", 1'000}, {"dpor", 20'000}};
  for (Tally& tally : tallies)
    if (asked.schedules != 0) tally.schedules_max = asked.schedules;
  if (!asked.strategy.empty())
    std::erase_if(tallies, [&](const Tally& tally) { return tally.strategy != asked.strategy; });
  if (tallies.empty())
    throw BadInput("--strategy", "expected dfs, bounded:1000 or dpor, found '" + std::string(asked.strategy) + "'");
  const bool are_small = asked.is_exec && asked.strategy != "dpor";
  const bool is_single = !asked.program.empty();
  for (std::uint64_t i = 0; i < (is_single ? 1 : asked.count); ++i) {
    // Each schedule of threads takes a process: the number of schedules must be small.
    const std::uint64_t number = are_small ? 2 * (asked.first + i) : asked.first + i;
    const Program program = is_single ? read_program(asked.program) : make_program(number, asked.is_exec);
    const Enumerated all = enumerate(program, states_max);
    for (Tally& tally : tallies) compare_one(program, all, cover_by, tally, asked.is_exec ? " --exec" : "");
    if (asked.is_exec || i % 100 == 99) note_progress(i + 1, asked.count);
  }
  std::size_t different = 0;
  for (const Tally& tally : tallies) {
    std::printf(
        "%s: %zu equal, %zu different, %zu that leave out turns of spinning tasks, %zu unfinished; %llu schedules\n",
        tally.strategy, tally.equal, tally.different, tally.left_out, tally.unfinished,
        static_cast<unsigned long long>(tally.schedules));
    different += tally.different;
  }
  return different == 0 ? 0 : 1;
}

}  // namespace
}  // namespace waitpoint::completeness

int main(int count, char** arguments) {
  try {
    return waitpoint::completeness::run(waitpoint::completeness::read(count, arguments));
  } catch (const waitpoint::BadInput& input) {
    std::fprintf(stderr, "completeness: %s\n", input.what());
    return 2;
  }
}
