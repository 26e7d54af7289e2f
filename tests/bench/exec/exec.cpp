// SPDX-License-Identifier: BSD-3-Clause
// Costs of calls in a program run by `waitpoint exec`, compared with the same program run natively.
//
// Both are the same binary; times are real, the best of several runs. Simulated and native runs alternate.
#include <fmt/format.h>
#include <x86intrin.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <thread>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tests/bench/program.hpp"

namespace waitpoint::bench {
namespace {

// The programs report ticks of the processor's counter, since their clocks are simulated.
double ns_per_tick() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const unsigned long long ticks = __rdtsc();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::chrono::duration<double, std::nano> time = Clock::now() - begin;
  return time.count() / static_cast<double>(__rdtsc() - ticks);
}

class Bench {
 public:
  Bench(int repeats, std::string only) : repeats_(repeats), only_(std::move(only)), ns_per_tick_(ns_per_tick()) {
    const auto folder = std::filesystem::canonical("/proc/self/exe").parent_path();
    calls_ = (folder / "exec-calls").string();
    exec_ = (folder / "../../tools/waitpoint").lexically_normal().string() +
            " exec --quiet --strategy fifo --idle-limit 0 -- ";
    explore_ = (folder / "../../tools/waitpoint").lexically_normal().string() + " explore --strategy random";
  }

  void run() {
    beside("mutex, lock + unlock", "lock", 5'000'000, 5'000'000, 0.5);
    at_most("mutex, lock + unlock", 15, "ns");
    beside("hand-over by a condition", "hand-over", 200'000, 20'000, 30);
    beside("create + join", "create", 50'000, 20'000, 10);
    simulated("switch, with thread-local storage", "switch", 2'000'000);
    at_most("switch, with thread-local storage", 30, "ns");
    simulated("two virtual hours of four threads that sleep", "sleepers", 1);
    at_most("two virtual hours of four threads that sleep", 50e6, "ns");
    simulated("30 000 threads at once, each", "many", 30'000);
    run_channels();
    run_processes();
  }
  void run_channels() {
    beside("pipe, write + read", "pipe", 200'000, 200'000, 0.667);
    beside("hand-over by pipes", "threads-pipes", 200'000, 20'000, 1);
    beside("hand-over by a socket pair", "threads-socket-pair", 200'000, 20'000);
  }
  void run_processes() {
    beside("processes, hand-over by semaphores", "processes-semaphores", 20'000, 20'000);
    at_most("processes, hand-over by semaphores", 6000, "ns");
    beside("processes, hand-over by pipes", "processes-pipes", 20'000, 20'000);
    beside("processes, hand-over by TCP", "processes-tcp", 20'000, 20'000);
    beside("process, fork + wait", "fork", 200, 200);
    beside("process, posix_spawn + wait", "spawn", 50, 50);
    explored("explored schedule of three threads", "three", 2'000);
    at_most("explored schedule of three threads", 500'000, "ns");
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  // Throws unless the command ends well; `read` takes a number from the line, if it is there.
  static double number_of(const std::string& command, bool (*read)(const std::string& line, double& number)) {
    std::FILE* const output = popen(command.c_str(), "r");
    char text[256] = {};
    const bool answered = output != nullptr && std::fgets(text, sizeof text, output) != nullptr;
    const bool ended_well = output != nullptr && pclose(output) == 0;
    double number = 0;
    if (!answered || !ended_well || !read(text, number)) throw BadInput(command, "did not answer");
    return number;
  }
  double run_once(const std::string& before, const std::string& workload, long count) const {
    const auto whole = [](const std::string& line, double& ticks) {
      return parse_number(line.substr(0, line.find('\n')), ticks);
    };
    return number_of(before + calls_ + " " + workload + " " + std::to_string(count), whole) * ns_per_tick_;
  }
  // By the rate that the explorer states: "... in 1.0 s (123.4 a second)".
  double explore_once(const char* workload, int schedules) const {
    const auto rate = [](const std::string& line, double& number) {
      const std::size_t begin = line.find(" s (") + 4, end = line.find(" a second)");
      return end != std::string::npos && parse_number(line.substr(begin, end - begin), number);
    };
    return 1e9 / number_of(fmt::format("{} --iterations {} -- {} {} 1", explore_, schedules, calls_, workload), rate);
  }
  void explored(const std::string& what, const char* workload, int schedules) {
    if (!is_asked(what)) return;
    last_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats_; ++i) last_ = std::min(last_, explore_once(workload, schedules));
    add(what, "waitpoint", last_, "ns");
  }
  bool is_asked(const std::string& what) const { return what.find(only_) != std::string::npos; }
  void simulated(const std::string& what, const char* workload, long count) {
    if (!is_asked(what)) return;
    last_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats_; ++i) last_ = std::min(last_, run_once(exec_, workload, count));
    add(what, "waitpoint", last_, "ns");
  }
  void beside(const std::string& what, const char* workload, long count, long count_native,
              std::optional<double> must = {}) {
    if (!is_asked(what)) return;
    double native = last_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats_; ++i) {
      last_ = std::min(last_, run_once(exec_, workload, count));
      native = std::min(native, run_once("", workload, count_native));
    }
    add(what, "waitpoint", last_, "ns");
    add(what, "native", native, "ns");
    add(what + ", native to it", "waitpoint", native / last_, "x", must);
  }
  void at_most(const std::string& what, double most, const char* unit) {
    if (is_asked(what)) add(what + fmt::format(", {:g} {} to it", most, unit), "waitpoint", most / last_, "x", 1);
  }
  void add(const std::string& what, const char* who, double value, const char* unit, std::optional<double> must = {}) {
    rows_.push_back({"exec", what, who, value, unit, must});
    fmt::print("{}", table_row(rows_.back()));
    std::fflush(stdout);
  }

  int repeats_;
  std::string only_;
  double ns_per_tick_;
  std::string calls_, exec_, explore_;
  double last_ = 0;
  std::vector<Row> rows_;
};

int main(int argc, char** argv) {
  CLI::App app("What calls of threads and processes cost in a program that `waitpoint exec` runs, and natively.");
  int repeats = 3;
  app.add_option("--repeats", repeats, "runs of which the fastest counts")->check(CLI::Range(1, 1000));
  std::string only;
  app.add_option("--case", only, "only rows with this text in their names");
  return run_program(app, argc, argv, [&] {
    Bench bench(repeats, only);
    bench.run();
    return bench.rows();
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
