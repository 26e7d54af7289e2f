// SPDX-License-Identifier: BSD-3-Clause
// The kernel's speed, compared with its peers and the limit, in one run.
//
// Each figure is the best of several measurements, each in its own process. Measurements of one workload alternate
// between subjects, so that disturbances affect all alike.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tests/bench/kernel/cases.hpp"
#include "tests/bench/kernel/measured.hpp"
#include "tests/bench/program.hpp"
#include "tests/bench/status_line.hpp"
#include "tests/bench/surroundings.hpp"

namespace waitpoint::bench {
namespace {

struct Options {
  int repeats = 3, budget_ms = 100, limit_s = 60;
  bool peers = true, hooks = true;
  int tasks_max = 1'000'000;
  std::string pattern;
};

/// The result of one subject in one case.
struct Figure {
  const Subject* subject;
  bool hooks;
  Measured best;

  double value(const std::string& answer) const {
    const auto found = best.values.find(answer);
    return found == best.values.end() ? 0 : found->second;
  }
};

std::string case_name(const Case& of) {
  return fmt::format("{}, {} task{}", of.title, of.tasks, of.tasks == 1 ? "" : "s");
}

class Bench {
 public:
  Bench(Options options, std::filesystem::path folder) : options_(std::move(options)), folder_(std::move(folder)) {
    for (const Subject& subject : subjects()) {
      if (subject.peer && !options_.peers) continue;
      if (std::filesystem::exists(program(subject)))
        present_.push_back(&subject);
      else
        fmt::print("left out, for it is not installed: {}\n", subject.name);
    }
    if (!options_.peers) fmt::print("peers are left out\n");
  }

  void run(const Case& of) {
    std::vector<Figure> figures;
    for (const Subject* subject : present_) {
      if (subject->tasks_max != 0 && of.tasks > subject->tasks_max) continue;
      figures.push_back({subject, false, {}});
      if (subject == present_.front() && options_.hooks && of.has_hooks()) figures.push_back({subject, true, {}});
    }
    const int repeats = of.tasks <= 100'000 ? options_.repeats : 1;
    for (int i = 1; i <= repeats; ++i)
      for (Figure& figure : figures) measure(of, figure, i, repeats);
    status_.show("");
    std::erase_if(figures, [](const Figure& f) { return f.best.end == Measured::End::declined; });
    print(of, figures);
  }

  void print_heading() {
    fmt::print("\n{:<23}{:>8}  {:<20}{:>10} {:<19}{:>8}{:>9}{:>9}\n", "workload", "tasks", "who", "figure", "unit",
               "ratio", "must", "aim");
  }
  void print_sum() { fmt::print("\n{} of {} musts met, {} of {} aims\n", musts_met_, musts_, aims_met_, aims_); }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::filesystem::path program(const Subject& subject) const { return folder_ / ("kernel-" + subject.program); }

  void measure(const Case& of, Figure& figure, int number, int repeats) {
    if (number > 1 && figure.best.end != Measured::End::answered) return;
    status_.show(fmt::format("{}: {} of {}, {}", case_name(of), number, repeats, figure.subject->name));
    keep_best(figure.best, measure_once(program(*figure.subject), of.workload, of.tasks, options_.budget_ms,
                                        figure.hooks, options_.limit_s));
  }

  void print(const Case& of, const std::vector<Figure>& figures) {
    const Figure& ours = figures.front();
    for (const Figure& figure : figures) {
      const std::string& name = figure.subject->name;
      if (figure.best.end != Measured::End::answered) {
        line(of, name, figure.best.why);
        continue;
      }
      if (&figure == &ours) {
        for (const auto& [answer, value] : figure.best.values) print_ours(of, answer, value);
        print_guard(of, figure);
      } else if (figure.hooks) {
        print_ratio(of, figure, name + ", hooks on", figure.value("ns") / ours.value("ns"), "");
      } else if (ours.best.end == Measured::End::answered) {
        const char* answer = figure.value("ns") > 0 ? "ns" : "bytes";
        const double ratio = figure.value(answer) / ours.value(answer);
        print_ratio(of, figure, name, name == "limit" ? 1 / ratio : ratio, name);
        print_guard(of, figure);
        if (figure.value("served_apart") > 0)
          line(of, name, fmt::format("{:>10.2f} of an equal share for the least served", figure.value("served_least")));
      }
    }
    fmt::print("\n");
    std::fflush(stdout);
  }

  void print_ours(const Case& of, const std::string& answer, double value) {
    const std::string bounds = judge(of, answer, "", value);
    static const std::map<std::string, std::string> units = {{"bytes", "bytes a task"},
                                                             {"page_table_bytes", "bytes, page tables"},
                                                             {"resident_gb", "GB resident"},
                                                             {"served_apart", "lockings apart"}};
    if (answer == "served_least" || (answer == "resident_gb" && of.tasks < 100'000)) return;
    const std::string unit = answer == "ns" ? of.unit : units.at(answer);
    line(of, "waitpoint", fmt::format("{:>10.1f} {:<19}{:>8}{}", value, unit, "", bounds));
    rows_.push_back({"kernel", case_name(of), "waitpoint", value, unit});
  }

  void print_ratio(const Case& of, const Figure& figure, const std::string& who, double ratio,
                   const std::string& against) {
    const bool timed = figure.value("ns") > 0;
    const double value = timed ? figure.value("ns") : figure.value("bytes");
    const std::string unit = timed ? of.unit : "bytes a task";
    const std::string bounds = against.empty() ? "" : judge(of, "ns", against, ratio);
    line(of, who, fmt::format("{:>10.1f} {:<19}{:>7.2f}x{}", value, unit, ratio, bounds));
    rows_.push_back({"kernel", case_name(of) + (figure.hooks ? ", hooks on" : ""), figure.subject->name, value, unit});
    Row row{"kernel", fmt::format("{}, ratio to {}", case_name(of), figure.hooks ? "hooks off" : who), "waitpoint",
            ratio, "times"};
    for (const Bound& must : of.musts)
      if (!against.empty() && must.against == against) row.must = must.bound;
    rows_.push_back(std::move(row));
  }

  /// The kind of stack guards, if the number of stacks makes a difference.
  void print_guard(const Case& of, const Figure& figure) {
    const auto guard = figure.best.words.find("guard");
    if ((of.tasks < 100'000 && of.workload != "parked") || guard == figure.best.words.end()) return;
    line(of, figure.subject->name, "           stacks: " + guard->second);
  }

  /// The columns "must" and "aim" of a figure, with a mark if met.
  std::string judge(const Case& of, const std::string& answer, const std::string& against, double value) {
    const auto column = [&](const std::vector<Bound>& bounds, int& count, int& met) -> std::string {
      for (const Bound& bound : bounds) {
        if (bound.answer != answer || bound.against != against) continue;
        const bool at_least = !against.empty() && against != "limit";
        const bool is_met = at_least ? value >= bound.bound : value <= bound.bound;
        ++count;
        met += is_met ? 1 : 0;
        return fmt::format("{}{:.4g} {}", at_least ? ">" : "<", bound.bound, is_met ? "yes" : "NO ");
      }
      return "";
    };
    const std::string must = column(of.musts, musts_, musts_met_), aim = column(of.aims, aims_, aims_met_);
    return fmt::format("{:>10}{:>10}", must, aim);
  }

  void line(const Case& of, const std::string& who, const std::string& rest) {
    fmt::print("{:<23}{:>8}  {:<20}{}\n", of.title, of.tasks, who, rest);
  }

  Options options_;
  std::filesystem::path folder_;
  std::vector<const Subject*> present_;
  std::vector<Row> rows_;
  StatusLine status_{is_terminal()};
  int musts_ = 0, musts_met_ = 0, aims_ = 0, aims_met_ = 0;
};

bool is_wanted(const Case& of, const Options& options) {
  return of.tasks <= options.tasks_max &&
         (case_name(of) + " " + of.workload).find(options.pattern) != std::string::npos;
}

int main(int argc, char** argv) {
  CLI::App app("How fast the kernel is, beside its peers and the limit.");
  Options options;
  bool no_peers = false, no_hooks = false, quick = false;
  app.add_flag("--no-peers", no_peers, "us and the limit alone");
  app.add_flag("--no-hooks", no_hooks, "without the measurements with a watch on the kernel");
  app.add_flag("--quick", quick, "two short measurements each, and no million tasks");
  app.add_option("--case", options.pattern, "only the workloads in whose names this is");
  app.add_option("--repeats", options.repeats, "measurements of which the best counts")->check(CLI::Range(1, 1000));
  return run_program(app, argc, argv, [&] {
    options.peers = !no_peers;
    options.hooks = !no_hooks;
    if (quick) options.repeats = 2, options.budget_ms = 40, options.tasks_max = 100'000;
    fmt::print("{}", surroundings({"libboost-context-dev", "libsystemc-dev", "libsimgrid-dev", "libboost-fiber-dev"}));
    Bench bench(options, std::filesystem::canonical("/proc/self/exe").parent_path());
    bench.print_heading();
    for (const Case& of : cases())
      if (is_wanted(of, options)) bench.run(of);
    bench.print_sum();
    return bench.rows();
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
