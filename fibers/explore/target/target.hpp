// SPDX-License-Identifier: BSD-3-Clause
// The subject of an exploration: a body, a scenario or a program. Each schedule is a run of it.
//
// The loop of a search runs its schedules in its own way, a body's in this process, others' in processes, and passes
// verdicts. The analysis of a failure repeats runs by their plans, with the evidence that it wants.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"
#include "fibers/explore/target/wanted_evidence.hpp"

namespace waitpoint::exploration {

/// What a part of an analysis may cost.
struct Effort {
  std::uint64_t runs;
  std::uint64_t events = ~std::uint64_t{0};  ///< in total
  double seconds = 0;                        ///< of the wall clock; 0: no limit
};

/// The properties of a target's runs.
struct TargetTraits {
  Effort to_minimize, to_explain;
  /// Runs are cheap: all alternatives of a schedule are tried. Otherwise a few random ones stand for them.
  bool is_cheap = false;
  /// Runs differ in more than their schedules: each number has its own noise, and number 0 the target's own.
  bool has_noise = false;
  /// A line for a failure by a schedule where the default order, which had passed, fails with the same noise.
  const char* default_fails_too = "";
  /// A line, if events of different runs cannot be compared; else null.
  const char* incomparable = nullptr;

  /// With other switches the same failure may occur somewhat later: up to here. A run that gets further counts as
  /// passed.
  Time latest(const Finding& failure) const { return is_cheap ? Time::max() : failure.end + std::chrono::seconds(5); }
};

class Target {
 public:
  virtual ~Target() = default;

  /// The name in reports.
  virtual std::string name() const = 0;
  virtual TargetTraits traits() const = 0;
  /// The command that repeats a run, by its token or by a file with its schedule.
  virtual std::string replay_command(const Finding& finding, const std::string& token) const = 0;
  /// Executes the run by the plan; nothing if a signal interrupted it.
  virtual std::optional<Finding> repeat(const Plan& plan, const WantedEvidence& wanted) = 0;
  std::optional<Finding> repeat(const Plan& plan) { return repeat(plan, {}); }
};

}  // namespace waitpoint::exploration
