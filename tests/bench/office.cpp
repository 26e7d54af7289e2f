// SPDX-License-Identifier: BSD-3-Clause
// Speed of the shipped scenarios relative to real time, digest included, and the cost of each module.
//
// The speed is that of the fastest of several whole missions, by the wall clock. The costs come from one more mission,
// in which a watch reads the clock at every event: the time since the previous event belongs to the task of that event,
// including its share of the scheduler's work. The readings slow that mission down a little.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <map>

#include "fibers/kernel/watch.hpp"
#include "modules/run/experiment.hpp"
#include "tests/bench/floors.hpp"
#include "tests/bench/program.hpp"
#include "tests/bench/status_line.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::bench {
namespace {

struct Case {
  std::string scenario;
  int floors = 1;                   // multiplies the robots
  std::optional<double> must = {};  // relative to real time
  Duration at_most = std::chrono::minutes(10);
};
const std::vector<Case> cases = {{"office.yaml", 1, 50},
                                 {"office-10.yaml", 1, 8},
                                 {"office-10.yaml", 10, 5},
                                 {"office-10.yaml", 100, std::nullopt, std::chrono::seconds(5)}};

// Many floors use the engine for many robots; the digest is the same with both.
scenario::Scenario scenario_of(const Case& of) {
  scenario::Scenario scenario = runs::shipped(of.scenario);
  if (of.floors > 1) {
    scenario = side_by_side(scenario, of.floors);
    scenario.engine = world::Engine::slice;
  }
  scenario.until = std::min(scenario.until, of.at_most);
  return scenario;
}

std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

/// Wall time by task, while attached to a run.
class Costs : public kernel::Watch {
 public:
  Costs() : Watch{&Costs::take} { last_ns_ = clock_ns(CLOCK_MONOTONIC); }

  /// Nanoseconds by module: tasks are named "<module>.<task>".
  std::map<std::string, std::int64_t> by_module() const {
    std::map<std::string, std::int64_t> costs;
    for (const auto& [task, cost] : by_task_) costs[task.substr(0, task.find('.'))] += cost;
    return costs;
  }

 private:
  static void take(kernel::Watch& watch, const kernel::EventRecord& event) {
    auto& self = static_cast<Costs&>(watch);
    const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    if (self.cost_ != nullptr) *self.cost_ += now_ns - self.last_ns_;
    if (event.task->name != self.name_) {
      self.name_ = event.task->name;
      self.cost_ = &self.by_task_[event.task->name];
    }
    self.last_ns_ = clock_ns(CLOCK_MONOTONIC);
  }

  std::map<std::string, std::int64_t> by_task_;
  const char* name_ = nullptr;  // of the previous event's task
  std::int64_t* cost_ = nullptr;
  std::int64_t last_ns_;
};

struct Speed {
  double simulated_s = 0, wall_s = 0, processor_s = 0;
};

Speed carry_out(const scenario::Scenario& scenario, const std::string& what, Costs* costs) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
  if (costs != nullptr) kernel::set_watch(experiment.simulation().scheduler(), costs);
  const std::int64_t wall_ns = clock_ns(CLOCK_MONOTONIC), processor_ns = clock_ns(CLOCK_PROCESS_CPUTIME_ID);
  const Time until = Time() + scenario.until;
  RunEnd end = RunEnd::time_reached;
  StatusLine status(is_terminal());
  for (Time reached; end == RunEnd::time_reached && reached < until;) {
    reached = std::min(until, reached + std::chrono::seconds(1));
    end = experiment.run_before(reached);
    status.show(fmt::format("{}: {} s simulated, {} of {} goals", what, to_string(reached), experiment.goals_reached(),
                            experiment.goals()));
  }
  status.show("");
  return {experiment.simulation().global_time().seconds(),
          1e-9 * static_cast<double>(clock_ns(CLOCK_MONOTONIC) - wall_ns),
          1e-9 * static_cast<double>(clock_ns(CLOCK_PROCESS_CPUTIME_ID) - processor_ns)};
}

class Bench {
 public:
  void run(const Case& of, int repeats) {
    const scenario::Scenario scenario = scenario_of(of);
    const std::string bench = scenario.name;
    double by_wall = 0, by_processor = 0;
    for (int i = 1; i <= repeats; ++i) {
      const Speed speed = carry_out(scenario, fmt::format("{}, mission {} of {}", bench, i, repeats), nullptr);
      by_wall = std::max(by_wall, speed.simulated_s / speed.wall_s);
      by_processor = std::max(by_processor, speed.simulated_s / speed.processor_s);
    }
    add({bench, "whole mission", "waitpoint", by_wall, "times real time", of.must});
    add({bench, "whole mission, processor time", "waitpoint", by_processor, "times real time"});

    Costs costs;
    const Speed watched = carry_out(scenario, bench + ", what the modules cost", &costs);
    std::vector<std::pair<std::int64_t, std::string>> modules;
    std::int64_t all = 0;
    for (const auto& [module, cost] : costs.by_module()) {
      modules.push_back({cost, module});
      all += cost;
    }
    std::sort(modules.rbegin(), modules.rend());
    for (const auto& [cost, module] : modules)
      add({bench, "cost of a simulated second", module, 1e-3 * static_cast<double>(cost) / watched.simulated_s, "us"});
    for (const auto& [cost, module] : modules)
      add({bench, "share of the time", module, 100.0 * static_cast<double>(cost) / static_cast<double>(all), "%"});
  }

  const std::vector<Row>& rows() const { return rows_; }

 private:
  void add(Row row) {
    fmt::print("{}", table_row(row));
    std::fflush(stdout);
    rows_.push_back(std::move(row));
  }

  std::vector<Row> rows_;
};

int main(int argc, char** argv) {
  CLI::App app("How fast the shipped scenarios run, and what each module costs.");
  int repeats = 3;
  app.add_option("--repeats", repeats, "missions of which the fastest counts")->check(CLI::Range(1, 1000));
  return run_program(app, argc, argv, [&] {
    Bench bench;
    for (const Case& of : cases) bench.run(of, repeats);
    return bench.rows();
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
