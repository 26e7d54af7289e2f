// SPDX-License-Identifier: BSD-3-Clause
// Costs of thread calls in a program run by `waitpoint exec`, compared with the same program run natively.
//
// Both are the same binary; times are real, the best of several runs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tests/bench/program.hpp"

namespace waitpoint::bench {
namespace {

class Bench {
 public:
  explicit Bench(int repeats) : repeats_(repeats) {
    const auto folder = std::filesystem::canonical("/proc/self/exe").parent_path();
    calls_ = (folder / "exec-calls").string();
    exec_ = (folder / "../../tools/waitpoint").lexically_normal().string() + " exec --quiet --strategy fifo -- ";
  }

  void run() {
    beside("mutex, lock + unlock", "lock", 5'000'000, 5'000'000, 0.5);
    at_most("mutex, lock + unlock", 15, "ns");
    beside("hand-over by a condition", "hand-over", 200'000, 20'000, 30);
    beside("create + join", "create", 50'000, 20'000, 10);
    simulated("switch, with thread-local storage", "switch", 2'000'000, "ns");
    at_most("switch, with thread-local storage", 30, "ns");
    simulated("two virtual hours of four threads that sleep", "sleepers", 1, "ns");
    at_most("two virtual hours of four threads that sleep", 50e6, "ns");
    simulated("30 000 threads at once, each", "many", 30'000, "ns");
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  double measure(const std::string& before, const std::string& workload, long count) const {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats_; ++i) {
      const std::string command = before + calls_ + " " + workload + " " + std::to_string(count);
      std::FILE* const output = popen(command.c_str(), "r");
      char text[64] = {};
      const bool answered = output != nullptr && std::fgets(text, sizeof text, output) != nullptr;
      const bool ended_well = output != nullptr && pclose(output) == 0;
      double ns = 0;
      if (!answered || !ended_well ||
          !parse_number(std::string(text, std::min<std::size_t>(63, std::string(text).find('\n'))), ns))
        throw BadInput(command, "did not answer");
      best = std::min(best, ns);
    }
    return best;
  }
  void simulated(const std::string& what, const char* workload, long count, const char* unit) {
    last_ = measure(exec_, workload, count);
    add(what, "waitpoint", last_, unit);
  }
  void beside(const std::string& what, const char* workload, long count, long count_native, double must) {
    simulated(what, workload, count, "ns");
    const double native = measure("", workload, count_native);
    add(what, "native", native, "ns");
    add(what + ", native to it", "waitpoint", native / last_, "x", must);
  }
  void at_most(const std::string& what, double most, const char* unit) {
    add(what + fmt::format(", {:g} {} to it", most, unit), "waitpoint", most / last_, "x", 1);
  }
  void add(const std::string& what, const char* who, double value, const char* unit, std::optional<double> must = {}) {
    rows_.push_back({"exec", what, who, value, unit, must});
    fmt::print("{}", table_row(rows_.back()));
    std::fflush(stdout);
  }

  int repeats_;
  std::string calls_, exec_;
  double last_ = 0;
  std::vector<Row> rows_;
};

int main(int argc, char** argv) {
  CLI::App app("What calls of threads cost in a program that `waitpoint exec` runs, and natively.");
  int repeats = 3;
  app.add_option("--repeats", repeats, "runs of which the fastest counts")->check(CLI::Range(1, 1000));
  return run_program(app, argc, argv, [&] {
    Bench bench(repeats);
    bench.run();
    return bench.rows();
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
