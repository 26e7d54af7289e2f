// SPDX-License-Identifier: BSD-3-Clause
// How many distinct schedules of a test body a second, on one core, and what one switch point costs.
//
// The body has about a hundred switch points: four threads that take a mutex in turn. Each strategy runs it for some
// time, the fastest of a few goes counts. Beside it, in the same run, the other ways to begin anew: a simulation made
// for each schedule, and a process forked for each.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <unordered_set>

#include "core/error.hpp"
#include "fibers/explore/body.hpp"
#include "fibers/explore/profile.hpp"
#include "fibers/explore/strategy.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/bench/rows.hpp"

namespace waitpoint::bench {
namespace {

constexpr double must_per_s = 100'000;
constexpr int goes = 5;

void contend() {
  constexpr int threads = 4, rounds = 7;
  mutex m;
  int count = 0;
  std::vector<thread> contenders;
  contenders.reserve(threads);
  for (int i = 0; i < threads; ++i)
    contenders.emplace_back([&] {
      for (int k = 0; k < rounds; ++k) {
        m.lock();
        ++count;
        m.unlock();
      }
    });
  for (thread& contender : contenders) contender.join();
}

struct Speed {
  double schedules = 0, distinct = 0, switch_points = 0, seconds = 0;
};

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// For `seconds`, schedule after schedule; `run` does one of that number and says how many switch points it had, and
/// its digest.
template <class Run>
Speed carry_on(double seconds, Run run) {
  Speed speed;
  std::unordered_set<std::uint64_t> seen;
  const double start_s = now_s();
  do {
    for (int i = 0; i < 16; ++i, ++speed.schedules) {
      const auto [switch_points, digest] = run(static_cast<std::uint64_t>(speed.schedules));
      speed.switch_points += switch_points;
      seen.insert(digest);
    }
    speed.seconds = now_s() - start_s;
  } while (speed.seconds < seconds);
  speed.distinct = static_cast<double>(seen.size());
  return speed;
}

using Done = std::pair<double, std::uint64_t>;

Speed by_strategy(const std::string& name, double seconds) {
  exploration::Body body(contend, nullptr, Time::max(), 100'000);
  exploration::Profile profile;
  (void)exploration::take_profile(body, profile);
  const auto strategy = exploration::make_strategy(name);
  return carry_on(seconds, [&](std::uint64_t number) -> Done {
    strategy->begin(number, exploration::Draws(1, name, number), profile);
    const exploration::Outcome outcome = body.run(*strategy);
    WAITPOINT_CHECK(outcome.passed(), "a body without bugs fails");
    (void)strategy->end();
    return {body.explorer().steps(), outcome.digest};
  });
}

Speed with_new_simulations(double seconds) {
  return carry_on(seconds, [](std::uint64_t number) -> Done {
    SimulationOptions options;
    options.order = kernel::Order::seeded;
    options.seed = number;
    const Report report = simulate(contend, options);
    return {static_cast<double>(report.events), report.digest.value()};
  });
}

// As tools do that cannot begin anew within a process. What the child saw does not come back: only its speed counts.
Speed with_forks(double seconds) {
  return carry_on(seconds, [](std::uint64_t number) -> Done {
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
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  template <class Run>
  Speed best(Run run) const {
    Speed best = run(seconds_ / goes);
    for (int i = 1; i < goes; ++i) {
      const Speed speed = run(seconds_ / goes);
      if (speed.schedules / speed.seconds > best.schedules / best.seconds) best = speed;
    }
    return best;
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
  std::string json;
  app.add_option("--seconds", seconds, "for each figure")->check(CLI::Range(0.1, 1000.0));
  app.add_option("--json", json, "file for the rows");
  CLI11_PARSE(app, argc, argv);
  try {
    Bench bench(seconds);
    bench.run();
    if (!json.empty()) write_json(json, bench.rows());
    return 0;
  } catch (const BadInput& error) {
    fmt::print(stderr, "explore: {}\n", error.what());
    return 2;
  }
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
