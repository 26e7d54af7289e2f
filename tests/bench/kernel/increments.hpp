// SPDX-License-Identifier: BSD-3-Clause
// Sleep times of the timed workloads' tasks, in nanoseconds of virtual time; the same for all subjects.
//
//   periods       each task its own period, all unequal, between 1 and 9 ms
//   harmonic      periods of 1, 2, 4 and 8 ms: many tasks are due at the same instant
//   common        each task has the period of 1 ms: all are due at one instant
//   exponential   mean 5 ms
//   bimodal       nine of ten sleeps about 0.5 ms, the tenth about 45 ms
//   far           99 of 100 sleeps about 5 ms, the last one 5 s: nine of ten tasks wait in the far future
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace waitpoint::bench {

/// Mixes the bits of `x` (the finaliser of splitmix64).
inline std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// In (0, 1).
inline double uniform(std::uint64_t number) { return (static_cast<double>(mixed(number) >> 12) + 0.5) * 0x1p-52; }

constexpr std::int64_t mean_sleep_ns = 5'000'000;

/// Period of task `i` of `tasks`: a random position in a random one of `tasks` equal parts of the range. Distinct, as
/// the parts are: a multiplication permutes them.
inline std::int64_t period_ns(int i, int tasks) {
  constexpr std::int64_t least = 1'000'000, range = 8'000'000, multiplier = 1'000'003;  // a prime above any task count
  const std::int64_t part = i * multiplier % tasks, width = range / tasks;
  return least + part * width +
         static_cast<std::int64_t>(uniform(static_cast<std::uint64_t>(i)) * static_cast<double>(width));
}

inline bool is_of_periods(const std::string& workload) {
  return workload == "periods" || workload == "harmonic" || workload == "common";
}

/// The period of task `i` of `tasks` in one of those workloads.
inline std::int64_t period_ns(const std::string& workload, int i, int tasks) {
  constexpr std::int64_t shortest = 1'000'000;
  if (workload == "periods") return period_ns(i, tasks);
  return workload == "harmonic" ? shortest << (i % 4) : shortest;
}

inline bool is_of_sleepers(const std::string& workload) {
  for (const char* kind : {"exponential", "bimodal", "far"})
    if (workload == kind) return true;
  return is_of_periods(workload);
}

/// Spans between 1 us and 1 ms, which all tasks cycle through.
class ShortSpans {
 public:
  ShortSpans() : list_(size) {
    for (std::size_t k = 0; k < size; ++k) list_[k] = 1'000 + static_cast<std::int64_t>(mixed(k) % 999'000);
  }
  std::int64_t operator[](std::uint64_t at) const { return list_[at % size]; }

 private:
  static constexpr std::size_t size = std::size_t{1} << 12;
  std::vector<std::int64_t> list_;
};

/// A long list of increments that all tasks cycle through: drawing them is almost free. A task starts at a random point
/// of all increments laid end to end, so that the mixture of short and long sleeps is stationary from the start.
class Increments {
 public:
  explicit Increments(const std::string& kind) : list_(size), ends_(size) {
    std::int64_t end = 0;
    for (std::size_t k = 0; k < size; ++k) ends_[k] = end += list_[k] = draw(kind, k);
  }
  std::int64_t mean_ns() const { return ends_.back() / static_cast<std::int64_t>(size); }

  /// The first sleep of a task, and the position of the next.
  std::int64_t first(int task, std::size_t& at) const {
    const auto point =
        static_cast<std::int64_t>(uniform(static_cast<std::uint64_t>(task)) * static_cast<double>(ends_.back()));
    const auto end = std::upper_bound(ends_.begin(), ends_.end() - 1, point);
    at = static_cast<std::size_t>(end - ends_.begin()) + 1;
    return *end - point;
  }
  /// The increment at `at`, which advances.
  std::int64_t next(std::size_t& at) const { return list_[at++ % size]; }

 private:
  static constexpr std::size_t size = std::size_t{1} << 14;

  static std::int64_t draw(const std::string& kind, std::uint64_t k) {
    const double mean = mean_sleep_ns, choice = uniform(2 * k), u = uniform(2 * k + 1);
    double ns = 0;
    if (kind == "exponential")
      ns = -mean * std::log(u);
    else if (kind == "bimodal")
      ns = choice < 0.9 ? 0.2 * mean * u : mean * (8.6 + u);
    else
      ns = choice < 0.99 ? 2 * mean * u : mean * (999.5 + u);
    return 1 + static_cast<std::int64_t>(ns);
  }

  std::vector<std::int64_t> list_;
  std::vector<std::int64_t> ends_;  // cumulative sums
};

}  // namespace waitpoint::bench
