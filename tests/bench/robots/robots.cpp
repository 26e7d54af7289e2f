// SPDX-License-Identifier: BSD-3-Clause
// Many robots with all modules: speed, memory of each, start, time per event.
//
// Each case runs in its own process, for its memory, and several times; the best figure of each kind counts.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "modules/run/experiment.hpp"
#include "tests/bench/kernel/meter.hpp"
#include "tests/bench/program.hpp"
#include "tests/bench/robots/crowds.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::bench {
namespace {

using namespace std::chrono_literals;

struct Case {
  std::string name;
  scenario::Scenario (*make)(int robots);
  int robots;
  Duration simulated;
};
const std::vector<Case> cases = {
    {"office floors", office_floors, 10, 60s},
    {"office floors", office_floors, 100, 20s},
    {"office floors", office_floors, 1000, 5s},
    {"hall", hall, 100, 20s},
    {"hall", hall, 1000, 5s},
    {"warehouse", warehouse_with, 100, 20s},
};
constexpr Duration started = 200ms, warm = 1s;  // by then all modules have computed, and all routes are planned

struct Figures {
  double start_s, speed, event_ns, robot_mb;
};

Figures measure(const Case& of) {
  const scenario::Scenario scenario = of.make(of.robots);
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const std::int64_t begun = clock_ns(Clock::processor);
  run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
  experiment.run_before(Time() + started);
  const std::int64_t from = clock_ns(Clock::processor);
  experiment.run_before(Time() + warm);
  const std::int64_t warmed = clock_ns(Clock::processor);
  const std::uint64_t events = kernel::events(experiment.simulation().scheduler());
  experiment.run_before(Time() + warm + of.simulated);
  const auto spent_ns = static_cast<double>(clock_ns(Clock::processor) - warmed);
  const auto executed = static_cast<double>(kernel::events(experiment.simulation().scheduler()) - events);
  return {1e-9 * static_cast<double>(from - begun), 1e9 * of.simulated.seconds() / spent_ns, spent_ns / executed,
          1e-6 * static_cast<double>(resident_bytes() + page_table_bytes()) / of.robots};
}

// The figures of a process that measures, which ends without teardown.
Figures measure_apart(const Case& of) {
  int ends[2];
  WAITPOINT_CHECK(pipe(ends) == 0, "no pipe to a measuring process");
  const pid_t id = fork();
  WAITPOINT_CHECK(id >= 0, "no measuring process can be started");
  if (id == 0) {
    const Figures figures = measure(of);
    const bool is_written = write(ends[1], &figures, sizeof figures) == sizeof figures;
    _exit(is_written ? 0 : 1);
  }
  close(ends[1]);
  Figures figures{};
  const bool is_read = read(ends[0], &figures, sizeof figures) == sizeof figures;
  close(ends[0]);
  waitpid(id, nullptr, 0);
  WAITPOINT_CHECK(is_read, "a measuring process has died");
  return figures;
}

Figures best_of(const Case& of, int repeats) {
  Figures best = measure_apart(of);
  for (int i = 1; i < repeats; ++i) {
    const Figures other = measure_apart(of);
    best = {std::min(best.start_s, other.start_s), std::max(best.speed, other.speed),
            std::min(best.event_ns, other.event_ns), std::min(best.robot_mb, other.robot_mb)};
  }
  return best;
}

int main(int argc, char** argv) {
  CLI::App app("How fast many robots run, and how much memory and time to start they need.");
  int repeats = 3;
  bool quick = false;
  std::string filter;
  app.add_option("--repeats", repeats, "processes per case, of which the best figures count")
      ->check(CLI::Range(1, 1000));
  app.add_flag("--quick", quick, "one simulated second after the first, in one process");
  app.add_option("--case", filter, "only cases with this text in their names: \"hall, 1000\"");
  return run_program(app, argc, argv, [&] {
    std::vector<Row> rows;
    const auto add = [&](Row row) {
      fmt::print("{}", table_row(row));
      std::fflush(stdout);
      rows.push_back(std::move(row));
    };
    for (Case of : cases) {
      const std::string name = fmt::format("{}, {} robots", of.name, of.robots);
      if (name.find(filter) == std::string::npos) continue;
      if (quick) of.simulated = 1s, repeats = 1;
      const Figures best = best_of(of, repeats);
      add({"robots", name, "waitpoint", best.speed, "times real time"});
      add({"robots", name, "waitpoint", best.robot_mb, "MB a robot"});
      add({"robots", name, "waitpoint", best.start_s, "s to start"});
      add({"robots", name, "waitpoint", best.event_ns, "ns an event"});
    }
    return rows;
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
