// SPDX-License-Identifier: BSD-3-Clause
// A temporal plan as values: actions with bounds on their durations, constraints between their starts and ends,
// resources, and alternative branches, in the manner of IxTeT-eXeC (S. Lemai, F. Ingrand, "Interleaving temporal
// planning and execution in robotics domains", AAAI 2004).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/setting.hpp"
#include "core/time.hpp"
#include "modules/plan/temporal_network.hpp"
#include "modules/scenario/location.hpp"

namespace waitpoint::plan {

/// A condition on a poster's value.
struct Condition {
  enum class Comparison : std::uint8_t { written, at_least, at_most, equals };
  std::string poster, field;
  Comparison comparison = Comparison::written;
  double value = 0;
  scenario::Location written;
};

/// The module whose requests are the procedures of the robot's script.
inline constexpr std::string_view script_module = "tcl";

/// A request to a module.
struct Request {
  std::string module, name;
  std::vector<Setting> input;
  bool takes_start = false;  ///< its input is the robot's known start
  scenario::Location written;

  bool is_to_script() const { return module == script_module; }
};

struct Resource {
  std::string name;
  std::uint32_t capacity = 1;
  scenario::Location written;
};

struct Use {
  std::size_t resource;
  std::uint32_t amount;
};

struct Action {
  std::string name;
  bool contingent = false;  ///< nature ends it, with the final report of its request; else the executor, at its choice
  Duration least, most = bound_max;
  std::optional<Request> request;  ///< dispatched at the start
  std::optional<Request> stop;     ///< sent in place of an abort of the request's activity
  std::string rendezvous;          ///< the other robot; empty: none
  std::vector<Condition> when;     ///< the start waits for all
  std::vector<Condition> during;   ///< it fails when one does not hold
  std::vector<Use> uses;
  std::optional<std::size_t> alternative;  ///< of which it is part of a branch
  std::size_t branch = 0;
  scenario::Location written;
};

/// `least <= to - from <= most`.
struct Constraint {
  std::string name;
  PointId from = origin, to = origin;
  std::optional<Duration> least, most;
  scenario::Location written;
};

/// Branches of which one is executed: the first, and the next each time that an action of it fails.
struct Alternative {
  std::string name;
  std::size_t branches = 0;
};

struct TemporalPlan {
  std::string file, name;
  std::vector<Request> setup;    ///< sent before the origin, each answered
  std::vector<Condition> ready;  ///< the origin waits for all
  std::vector<Resource> resources;
  std::vector<Action> actions;
  std::vector<Constraint> constraints;
  std::vector<Alternative> alternatives;
  std::vector<Request> safe;                       ///< sent after an abort: the safe state
  std::vector<Request> done;                       ///< sent after the last action
  Duration poll = std::chrono::milliseconds(100);  ///< period of looks at posters

  std::size_t points() const { return 1 + 2 * actions.size(); }
};

/// The points of action `i`.
constexpr PointId start_of(std::size_t i) { return static_cast<PointId>(1 + 2 * i); }
constexpr PointId end_of(std::size_t i) { return static_cast<PointId>(2 + 2 * i); }
constexpr std::size_t action_of(PointId point) { return (point - 1) / 2; }
constexpr bool is_start(PointId point) { return point % 2 == 1; }

}  // namespace waitpoint::plan
