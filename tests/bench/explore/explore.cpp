// SPDX-License-Identifier: BSD-3-Clause
// Distinct schedules of a test body per second on one core, and the cost of a switch point.
//
// Each strategy runs the body for some time; the fastest of several attempts counts, in processor time. Measured beside
// it, in the same run: the alternatives for restarting, a new simulation per schedule and a forked process per schedule
// (in wall clock time, as the time is another process's); and the body with instrumented accesses to memory.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.hpp"
#include "fibers/sync/simulation.hpp"
#include "tests/bench/explore/body.hpp"
#include "tests/bench/explore/throughput.hpp"
#include "tests/bench/kernel/measured.hpp"
#include "tests/bench/program.hpp"
#include "tests/project.hpp"

namespace waitpoint::bench {
namespace {

constexpr double must_per_s = 100'000;

Speed with_new_simulations(double seconds) {
  return carry_on(seconds, Clock::processor, [](std::uint64_t number) -> Done {
    SimulationOptions options;
    options.order = kernel::Order::seeded;
    options.seed = number;
    const Report report = simulate(contend, options);
    return {static_cast<double>(report.events), report.digest.value()};
  });
}

// The method of tools that cannot restart within a process. The child's results are dropped: only speed is measured.
Speed with_forks(double seconds) {
  return carry_on(seconds, Clock::wall, [](std::uint64_t number) -> Done {
    const pid_t child = fork();
    if (child == 0) {
      SimulationOptions options;
      options.order = kernel::Order::seeded;
      options.seed = number;
      _exit(simulate(contend, options).passed ? 0 : 1);
    }
    WAITPOINT_CHECK(child > 0, "no process can be had");
    int status = 0;
    waitpid(child, &status, 0);
    WAITPOINT_CHECK(status == 0, "a body without bugs fails");
    return {1, number};
  });
}

class Bench {
 public:
  explicit Bench(double seconds) : seconds_(seconds) {}

  void run() {
    const Speed forked = best([](double s) { return with_forks(s); });
    add("schedules", "fork", forked.schedules / forked.seconds, "schedules/s");
    const Speed made = best([](double s) { return with_new_simulations(s); });
    add("schedules", "new simulations", made.schedules / made.seconds, "schedules/s");
    for (const char* name : {"portfolio", "random", "pct:3", "pos", "urw", "surw", "dfs"}) {
      const Speed speed = best([&](double s) { return by_strategy(name, s); });
      const std::string which = std::string("strategy ") + name;
      const bool is_default = which == "strategy portfolio";
      add(which + ", distinct", "waitpoint", speed.distinct / speed.seconds, "schedules/s",
          is_default ? std::optional<double>(must_per_s) : std::nullopt);
      add(which + ", share distinct", "waitpoint", 100 * speed.distinct / speed.schedules, "%");
      add(which + ", a switch point", "waitpoint", 1e9 * speed.seconds / speed.switch_points, "ns");
      if (is_default) {
        add("switch points a schedule", "waitpoint", speed.switch_points / speed.schedules, "");
        add("all schedules", "waitpoint to fork", speed.schedules / speed.seconds / (forked.schedules / forked.seconds),
            "x");
        add("all schedules", "waitpoint to new simulations",
            speed.schedules / speed.seconds / (made.schedules / made.seconds), "x");
      }
    }
    add_instrumented();
    add_branches();
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  template <class Run>
  Speed best(Run run) const {
    return best_of_some(seconds_, run);
  }
  // Branches of the office from mid-run, each a forked process that runs for a second of virtual time.
  void add_branches() {
    const auto build = std::filesystem::canonical("/proc/self/exe").parent_path().parent_path().parent_path();
    const std::string command = fmt::format(
        "'{}' explore '{}' --from 60 --until 61 --strategy random --time-limit {} 2>/dev/null",
        (build / "tools/waitpoint").string(), (test::project_root() / "scenarios/office.yaml").string(), seconds_);
    FILE* const output = popen(command.c_str(), "r");
    WAITPOINT_CHECK(output != nullptr, "no process can be had");
    double schedules = 0, distinct = 0, spent = 0, rate = 0;
    const int found = std::fscanf(output, "office: %lf schedules, %lf distinct, 0 failed, in %lf s (%lf a second)",
                                  &schedules, &distinct, &spent, &rate);
    pclose(output);
    if (found != 4) throw BadInput("waitpoint explore", "expected schedules without a failure");
    add("branches of the office in mid-run", "waitpoint", rate, "branches/s");
    add("branches of the office in mid-run, share distinct", "waitpoint", 100 * distinct / schedules, "%");
  }
  // Accesses to shared memory are switch points in addition to the primitives.
  void add_instrumented() {
    const auto program = std::filesystem::canonical("/proc/self/exe").parent_path() / "explore-instrumented";
    if (!std::filesystem::exists(program)) return;
    const auto limit_s = static_cast<int>(10 * seconds_ + 60);
    const Measured measured = measure_once(program, "portfolio", 1, static_cast<int>(1000 * seconds_), false, limit_s);
    if (measured.end != Measured::End::answered) throw BadInput("explore-instrumented", measured.why);
    const auto value = [&](const char* name) { return measured.values.at(name); };
    add("instrumented body, distinct", "waitpoint", value("distinct") / value("seconds"), "schedules/s", must_per_s);
    add("instrumented body, a switch point", "waitpoint", 1e9 * value("seconds") / value("switch_points"), "ns");
    add("instrumented body, switch points a schedule", "waitpoint", value("switch_points") / value("schedules"), "");
  }
  void add(const std::string& what, const char* who, double value, const char* unit, std::optional<double> must = {}) {
    rows_.push_back({"explore", what, who, value, unit, must});
    fmt::print("{}", table_row(rows_.back()));
    std::fflush(stdout);
  }

  double seconds_;
  std::vector<Row> rows_;
};

int main(int argc, char** argv) {
  CLI::App app("How many distinct schedules a second, and what a switch point costs.");
  double seconds = 5;
  app.add_option("--seconds", seconds, "for each figure")->check(CLI::Range(0.1, 1000.0));
  return run_program(app, argc, argv, [&] {
    Bench bench(seconds);
    bench.run();
    return bench.rows();
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
