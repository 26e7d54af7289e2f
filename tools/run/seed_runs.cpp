// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/seed_runs.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/exception_text.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/kernel/unfinished_run.hpp"
#include "modules/run/ranks/archive.hpp"
#include "modules/run/ranks/results.hpp"
#include "tools/command/interruption.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/quantiles.hpp"
#include "tools/output/summary.hpp"
#include "tools/processes/children.hpp"
#include "tools/run/reports.hpp"
#include "tools/run/run_json.hpp"

namespace waitpoint::tools {
namespace {

constexpr int look_around_ms = 100;

struct Ended {
  bridge::RunResult result;
  std::string failure;  // empty: it has a result

  friend void carry(auto& archive, Ended& ended) { archive(ended.result, ended.failure); }
};

Ended run_one(const RunOptions& options, const RunOfSeed& run, std::uint64_t seed) {
  const std::string replay = replay_line(options, seed);
  const kernel::UnfinishedRun unfinished(replay.c_str());
  try {
    bridge::RunResult result = run(seed, replay);
    const kernel::Commit commit;
    return {std::move(result), ""};
  } catch (const BadInput&) {
    throw;
  } catch (const std::system_error&) {
    throw;
  } catch (const std::exception& failure) {
    return {{}, exception_text(failure)};
  }
}

// The runs in processes of their own, in the order of the seeds. `take` returns false to end the series.
void run_at_once(const RunOptions& options, const RunOfSeed& run,
                 const std::function<bool(std::uint64_t seed, Ended ended)>& take) {
  const auto work = [&](std::string_view job) {
    std::uint64_t seed = 0;
    run::Unpacking unpacking(job);
    unpacking(seed);
    run::Packing packing;
    packing(run_one(options, run, seed));
    return std::move(packing.bytes());
  };
  Children children(work, {});
  std::map<std::uint64_t, Ended> waiting;
  std::uint64_t next = options.seeds->first, taken = options.seeds->first;
  bool all_started = false;
  while (interruption() == 0 && (!all_started || children.count() > 0)) {
    for (; !all_started && children.count() < options.jobs; ++next) {
      run::Packing packing;
      packing(next);
      children.start(next, packing.bytes());
      all_started = next == options.seeds->last;
    }
    const std::optional<Children::Ended> done = children.wait(look_around_ms);
    if (!done) continue;
    Ended& ended = waiting[done->number];
    ended.failure = death_of(*done);
    if (ended.failure.empty()) {
      run::Unpacking unpacking(done->bytes);
      unpacking(ended);
    }
    for (auto first = waiting.find(taken); first != waiting.end(); first = waiting.find(++taken)) {
      if (!take(taken, std::move(first->second))) return;
      waiting.erase(first);
    }
  }
}

void run_in_turn(const RunOptions& options, const RunOfSeed& run,
                 const std::function<bool(std::uint64_t seed, Ended ended)>& take) {
  for (std::uint64_t seed = options.seeds->first; interruption() == 0; ++seed)
    if (!take(seed, run_one(options, run, seed)) || seed == options.seeds->last) return;
}

}  // namespace

int run_seeds(const RunOptions& options, const scenario::Scenario& scenario, const RunOfSeed& run) {
  std::optional<OutputFile> summary;
  if (options.summary) summary.emplace(*options.summary);
  std::vector<bridge::RunResult> results;
  int worst = 0;
  std::optional<FailedSeed> failed;
  Printed printed(options);
  printed.print(seeds_head());
  const auto take = [&](std::uint64_t seed, Ended ended) {
    if (!ended.failure.empty()) {
      failed = {seed, ended.failure, replay_line(options, seed)};
      report_failure(std::runtime_error(ended.failure), failed->replay, nullptr);
      return false;
    }
    results.push_back(std::move(ended.result));
    printed.print(seeds_row(results.back()));
    worst = std::max(worst, verdict(scenario, results.back()).status);
    return true;
  };
  options.jobs > 1 ? run_at_once(options, run, take) : run_in_turn(options, run, take);
  if (failed) return options.json ? end_with_json("run", 1, runs_json(results, failed)) : 1;
  if (results.size() > 1) printed.print(quantiles_text(results));
  if (summary) {
    summary->write(summary_json(results));
    summary->commit();
  }
  printed.check();
  const int status = interruption() != 0 ? 130 : worst;
  return options.json ? end_with_json("run", status, runs_json(results, failed)) : status;
}

}  // namespace waitpoint::tools
