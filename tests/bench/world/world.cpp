// SPDX-License-Identifier: BSD-3-Clause
// Speed of planar scans, compared with peers, in one run.
//
// A pass is a scan from each station of a place. Contenders alternate pass by pass, and the fastest pass of each
// counts, in processor time: so disturbances affect all alike.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "core/error.hpp"
#include "core/random.hpp"
#include "tests/bench/program.hpp"
#include "tests/bench/surroundings.hpp"
#include "tests/bench/world/contenders.hpp"
#include "tests/bench/world/crowds.hpp"

namespace waitpoint::bench {
namespace {

constexpr const char *us = "waitpoint", *fcl_trees = "waitpoint, fcl", *grid = "grid", *fcl_name = "libfcl-dev",
                     *embree_name = "libembree-dev", *box2d_name = "libbox2d-dev", *bullet_name = "libbullet-dev",
                     *ode_name = "libode-dev", *cgal_name = "libcgal-dev";

struct Subject {
  std::string name;
  bool peer, knows_meshes, knows_robots;
  std::unique_ptr<Contender> (*make)(const Place&);  // null: not installed
};
const std::vector<Subject> subjects = {
    {us, false, true, true, &our_slice},       {fcl_trees, false, true, true, &our_fcl_trees},
    {grid, false, false, true, &grid_of_5_cm},
#ifdef WAITPOINT_BENCH_EMBREE
    {embree_name, true, true, true, &embree},
#else
    {embree_name, true, true, true, nullptr},
#endif
#ifdef WAITPOINT_BENCH_BOX2D
    {box2d_name, true, false, true, &box2d},
#else
    {box2d_name, true, false, true, nullptr},
#endif
#ifdef WAITPOINT_BENCH_BULLET
    {bullet_name, true, false, true, &bullet},
#else
    {bullet_name, true, false, true, nullptr},
#endif
#ifdef WAITPOINT_BENCH_ODE
    {ode_name, true, false, true, &ode},
#else
    {ode_name, true, false, true, nullptr},
#endif
#ifdef WAITPOINT_BENCH_CGAL
    {cgal_name, true, false, false, &cgal},
#else
    {cgal_name, true, false, false, nullptr},
#endif
};

struct Bounds {
  std::map<std::string, double> musts, aims;  // minimum ratios to the named contender
};
const Bounds of_scans = {{{embree_name, 2.5}, {box2d_name, 25}, {grid, 7}}, {{embree_name, 3.5}}};
const Bounds of_mesh_scans = {{{embree_name, 1.5}}, {{embree_name, 2.5}}};
const Bounds of_collisions = {{{fcl_name, 5}}, {{fcl_name, 10}}};
const Bounds of_steps = {{{embree_name, 1 / 0.4}}, {{embree_name, 1 / 0.28}}};

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

std::vector<Point> anywhere(const Place& place, std::size_t count) {
  const RandomStream stream(1, place.name, "anywhere");
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({place.length_m * stream.uniform(2 * i), place.width_m * stream.uniform(2 * i + 1)});
  return points;
}

using Ranges = std::array<double, beams>;

/// One contender in one place.
struct Entry {
  std::string name;
  std::unique_ptr<Contender> contender;
  double best_ns = HUGE_VAL;  // a pass
  long answers_off = 0;       // beams off by more than ten centimetres, or differing collision answers
};

class Bench {
 public:
  Bench(bool peers, int repeats) : peers_(peers), repeats_(repeats) {
    for (const Subject& subject : subjects) {
      if (subject.peer && peers && subject.make == nullptr)
        fmt::print("left out, for it is not installed: {}\n", subject.name);
    }
    if (!peers) fmt::print("peers are left out\n");
    fmt::print("\n{:<34}{:<16}{:>10} {:<10}{:>10}{:>12}{:>12}{:>12}\n", "case", "who", "figure", "unit", "ratio",
               "must", "aim", "off > 10 cm");
  }

  void scans(const Place& place) {
    std::vector<Entry> entries = enter(place);
    const auto pass = [&](Contender& contender) {
      Ranges ranges;
      for (std::size_t i = 0; i < place.stations.size(); ++i) contender.scan(place.stations[i], own(place, i), ranges);
    };
    measure(entries, pass);
    print(place.name + ", a scan", entries, "ns a beam", 1 / answers_, place.meshes.empty() ? of_scans : of_mesh_scans);
  }

  /// All robots move by a centimetre, then scan.
  void steps(const Place& place) {
    std::vector<Entry> entries = enter(place);
    std::vector<world::Shape> there = place.robots;
    for (world::Shape& robot : there) robot.pose.x += 0.01;
    bool moved = false;
    const auto pass = [&](Contender& contender) {
      Ranges ranges;
      contender.place(moved ? place.robots : there);
      for (std::size_t i = 0; i < place.robots.size(); ++i) {
        Pose at = place.stations[i];
        if (!moved) at.x += 0.01;
        contender.scan(at, static_cast<std::uint32_t>(i), ranges);
      }
    };
    measure(entries, pass, [&] { moved = !moved; });
    print(place.name + ": move, scan", entries, "us a step", 1e-3, of_steps);
  }

  /// Tests of a robot's disc for collisions, at random places.
  void collisions(const Place& place) {
    const std::vector<Point> points = anywhere(place, 20'000);
    answers_ = static_cast<double>(points.size());
    const std::unique_ptr<Collider> ours = our_footprints(place), fcls = fcl_collide(place);
    std::vector<Entry> entries(2);
    entries[0].name = us;
    entries[1].name = fcl_name;
    for (const Point& point : points) entries[1].answers_off += ours->collides(point) != fcls->collides(point) ? 1 : 0;
    for (int i = 0; i < repeats_; ++i) {
      for (Entry& entry : entries) {
        Collider& collider = entry.name == us ? *ours : *fcls;
        const std::int64_t from = now_ns();
        for (const Point& point : points) collisions_ += collider.collides(point) ? 1 : 0;
        entry.best_ns = std::min(entry.best_ns, static_cast<double>(now_ns() - from));
      }
    }
    print(place.name + ", does a disc collide", entries, "ns a query", 1 / answers_, of_collisions);
  }

  /// Together with the other figures of this run.
  void print_sum(const Figures& others) const {
    fmt::print("{} of {} musts met, {} of {} aims\n", met_[0] + others.musts().met, bounds_[0] + others.musts().all,
               met_[1] + others.aims().met, bounds_[1] + others.aims().all);
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  static std::uint32_t own(const Place& place, std::size_t station) {
    return place.robots.empty() ? ~0u : static_cast<std::uint32_t>(station);
  }

  std::vector<Entry> enter(const Place& place) {
    answers_ = static_cast<double>(place.stations.size() * beams);
    std::vector<Entry> entries;
    for (const Subject& subject : subjects) {
      if (subject.make == nullptr || (subject.peer && !peers_)) continue;
      if (!subject.knows_meshes && !place.meshes.empty()) continue;
      if (!subject.knows_robots && !place.robots.empty()) continue;
      entries.push_back({subject.name, subject.make(place)});
    }
    for (std::size_t i = 0; i < place.stations.size(); ++i) {
      Ranges truth, ranges;
      entries[0].contender->scan(place.stations[i], own(place, i), truth);
      for (Entry& entry : entries) {
        entry.contender->scan(place.stations[i], own(place, i), ranges);
        for (std::size_t k = 0; k < beams; ++k) entry.answers_off += std::fabs(ranges[k] - truth[k]) > 0.1 ? 1 : 0;
        WAITPOINT_CHECK(entry.name != fcl_trees || ranges == truth, "our two engines differ");
      }
    }
    return entries;
  }

  void measure(
      std::vector<Entry>& entries, const std::function<void(Contender&)>& pass,
      const std::function<void()>& next = [] {}) const {
    for (int i = 0; i < repeats_; ++i) {
      for (Entry& entry : entries) {
        const std::int64_t from = now_ns();
        pass(*entry.contender);
        entry.best_ns = std::min(entry.best_ns, static_cast<double>(now_ns() - from));
      }
      next();
    }
  }

  void print(const std::string& name, const std::vector<Entry>& entries, const std::string& unit, double scale,
             const Bounds& bounds) {
    for (const Entry& entry : entries) {
      const std::string& who = entry.name;
      const double ratio = entry.best_ns / entries[0].best_ns;
      std::string line = fmt::format("{:<34}{:<16}{:>10.1f} {:<10}", name, who, scale * entry.best_ns, unit);
      rows_.push_back({"world", name, who, scale * entry.best_ns, unit});
      if (who != us) {
        line +=
            fmt::format("{:>9.2f}x{}{}", ratio, judge(bounds.musts, who, ratio, 0), judge(bounds.aims, who, ratio, 1));
        Row row{"world", name + ", ratio to " + who, us, ratio, "times"};
        if (const auto must = bounds.musts.find(who); must != bounds.musts.end()) row.must = must->second;
        rows_.push_back(std::move(row));
      }
      if (entry.answers_off > 0)
        line = fmt::format("{:<104}{:>10.2f} %", line, 100.0 * static_cast<double>(entry.answers_off) / answers_);
      fmt::print("{}\n", line);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }

  std::string judge(const std::map<std::string, double>& bounds, const std::string& who, double ratio,
                    std::size_t kind) {
    const auto bound = bounds.find(who);
    if (bound == bounds.end()) return fmt::format("{:>12}", "");
    const bool is_met = ratio >= bound->second;
    ++bounds_[kind];
    met_[kind] += is_met ? 1 : 0;
    return fmt::format("{:>12}", fmt::format(">{:.3g} {}", bound->second, is_met ? "yes" : "NO "));
  }

  bool peers_;
  int repeats_;
  long collisions_ = 0;                  // counted, so that the tests are not optimised away
  double answers_ = 0;                   // per pass
  std::array<int, 2> met_{}, bounds_{};  // of musts and of aims
  std::vector<Row> rows_;
};

/// By name, so that only the requested ones are built.
const std::vector<std::pair<const char*, Place (*)()>> places = {
    {"office", [] { return office(0); }},
    {"warehouse", [] { return warehouse(0); }},
    {"office, 100 robots", [] { return office(100); }},
    {"warehouse, 100 robots", [] { return warehouse(100); }},
    {"mesh", &mesh_hall},
};

/// Figures without peers.
const std::vector<std::pair<const char*, void (*)(bool quick, Figures&)>> figures_alone = {
    {"collisions", &collisions_of_a_hundred}, {"stage's cave", &stages_cave},  {"stage's hospital", &stages_hospital},
    {"simple robots", &simple_robots},        {"obstacles", &growing_grounds},
};

int main(int argc, char** argv) {
  CLI::App app("How fast planar scans are, beside peers: 361 beams over half a turn, 30 m; what crowds cost.");
  int repeats = 15;
  std::string pattern;
  bool no_peers = false, quick = false;
  app.add_flag("--no-peers", no_peers, "us and the grid alone");
  app.add_flag("--quick", quick, "few passes");
  app.add_option(
      "--case", pattern,
      "only the places, or 'collisions', 'stage's cave', 'stage's hospital', 'simple robots', 'obstacles', in "
      "whose names this is");
  app.add_option("--repeats", repeats, "passes of which the fastest counts")->check(CLI::Range(1, 10000));
  return run_program(app, argc, argv, [&] {
    fmt::print("{}", surroundings({fcl_name, embree_name, box2d_name, bullet_name, ode_name, cgal_name}));
    Bench bench(!no_peers, quick ? 3 : repeats);
    const auto is_wanted = [&](std::string_view name) { return name.find(pattern) != std::string_view::npos; };
    for (const auto& [name, make] : places) {
      if (!is_wanted(name)) continue;
      const Place place = make();
      bench.scans(place);
      if (!place.robots.empty())
        bench.steps(place);
      else
        bench.collisions(place);
    }
    Figures figures;
    for (const auto& [name, measure] : figures_alone)
      if (is_wanted(name)) measure(quick, figures);
    bench.print_sum(figures);
    std::vector<Row> rows = bench.rows();
    rows.insert(rows.end(), figures.rows().begin(), figures.rows().end());
    return rows;
  });
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
