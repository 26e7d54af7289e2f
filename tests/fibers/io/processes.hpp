// SPDX-License-Identifier: BSD-3-Clause
// A run whose robots are distributed over several processes, each of which is a simulation here: for tests. Each
// executes a window of the lookahead, then they exchange packets, as bytes.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {

using Log = std::vector<std::string>;
/// What a robot's task does, and what it notes.
using Body = std::function<void(Network& network, Log& log)>;

struct Trial {
  Medium medium;
  std::map<std::string, Body> bodies;                               ///< by robot
  std::function<double(Time)> distance_m = [](Time) { return 0; };  ///< of all robots
};

/// What comes of it.
struct Traces {
  std::map<std::string, Log> logs;
  std::map<std::string, std::string> digests;
  LinkStatistics statistics;  ///< of all links
  friend bool operator==(const Traces& a, const Traces& b) {
    const auto counts = [](const LinkStatistics& s) {
      return std::vector{s.sent, s.lost, s.out_of_range, s.overflowed, s.unreachable};
    };
    return a.logs == b.logs && a.digests == b.digests && counts(a.statistics) == counts(b.statistics);
  }
};

/// One process: all robots, and the tasks of some.
class Process {
 public:
  struct Forwarded {
    Time arrives;
    std::string sender;
    std::uint64_t count;
    std::string to;
    std::vector<std::byte> bytes;
  };

  Process(const Trial& trial, std::vector<std::string> names, const std::vector<std::string>& own,
          const SimulationOptions& options)
      : names_(std::move(names)), own_(own), fleet_(names_, trial.medium, options) {
    std::set<std::string, std::less<>> elsewhere(names_.begin(), names_.end());
    for (const std::string& name : own) elsewhere.erase(name);
    fleet_.network.set_elsewhere(elsewhere, [this](const kernel::Robot& sender, std::uint64_t count, Time arrives,
                                                   const std::string& to, const Packet& packet) {
      sent_.push_back({arrives, sender.name, count, to, to_bytes(packet)});
    });
    fleet_.network.set_distance(
        [this, distance_m = trial.distance_m](auto&, auto&) { return distance_m(fleet_.simulation.global_time()); });
    for (const std::string& name : own)
      fleet_.spawn(name, [this, name, body = trial.bodies.at(name)] {
        body(fleet_.network, traces_.logs[name]);
        --unfinished_;
      });
    unfinished_ = own.size();
    // A robot's packets are answered after its end, and others' awaited: the world goes on.
    fleet_.simulation.spawn(fleet_.simulation.environment(), {.name = "world"}, [] {
      for (;;) this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  }

  void run_before(Time until) {
    ASSERT_EQ(fleet_.simulation.run_before(until), RunEnd::time_reached) << fleet_.simulation.trouble();
  }
  std::vector<Forwarded> take_sent() { return std::exchange(sent_, {}); }
  bool has(const std::string& robot) const { return std::find(own_.begin(), own_.end(), robot) != own_.end(); }
  void arrive(const Forwarded& one) {
    fleet_.network.arrive_at(one.arrives, one.sender, one.count, one.to, packet_of(one.bytes));
  }
  bool has_ended() const { return unfinished_ == 0; }
  void add_to(Traces& traces) {
    for (const std::string& name : own_) {
      traces.logs[name] = traces_.logs[name];
      traces.digests[name] = fleet_.digest(name);
    }
    for (const std::string& from : names_)
      for (const std::string& to : names_) {
        const LinkStatistics here = from == to ? LinkStatistics() : fleet_.network.statistics(from, to);
        traces.statistics.sent += here.sent;
        traces.statistics.lost += here.lost;
        traces.statistics.out_of_range += here.out_of_range;
        traces.statistics.overflowed += here.overflowed;
        traces.statistics.unreachable += here.unreachable;
      }
  }

 private:
  std::vector<std::string> names_, own_;
  Traces traces_;
  std::vector<Forwarded> sent_;
  std::size_t unfinished_ = 0;
  Fleet fleet_;
};

/// Runs the trial with the robots of each group in a process of their own.
inline Traces run_in_processes(const Trial& trial, const std::vector<std::vector<std::string>>& groups,
                               const SimulationOptions& options) {
  std::vector<std::string> names;
  for (const auto& [name, body] : trial.bodies) names.push_back(name);
  std::vector<std::unique_ptr<Process>> processes;
  processes.reserve(groups.size());
  for (const std::vector<std::string>& own : groups)
    processes.push_back(std::make_unique<Process>(trial, names, own, options));
  const Duration window = trial.medium.latency_least;
  const auto has_ended = [](const auto& process) { return process->has_ended(); };
  for (Time until = Time() + window; !std::all_of(processes.begin(), processes.end(), has_ended); until += window) {
    for (const auto& process : processes) process->run_before(until);
    if (testing::Test::HasFatalFailure()) break;
    for (const auto& from : processes)
      for (const Process::Forwarded& one : from->take_sent())
        for (const auto& to : processes)
          if (to->has(one.to)) to->arrive(one);
  }
  Traces traces;
  for (const auto& process : processes) process->add_to(traces);
  return traces;
}

}  // namespace waitpoint::io
