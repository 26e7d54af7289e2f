// SPDX-License-Identifier: BSD-3-Clause
// The executor of a temporal plan: a task above the modules, in the place of the executive. It sends the requests of
// actions when they are due, reads the posters of conditions, and aborts activities whose end has come.
//
// Its times are exact: between a report and its decision, and at a time that is due, no virtual time passes. Each entry
// of the log is written to the poster plan.log, and so is part of the digest.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "modules/genom/client.hpp"
#include "modules/plan/execution.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::plan {

/// The content of plan.log.
struct LoggedEvent {
  Time date;
  EventKind kind = EventKind::start;
  std::uint32_t index = 0;   ///< of the action, or the alternative
  std::uint32_t number = 0;  ///< of the entry

  static void fields(auto field) {
    field("date", &LoggedEvent::date);
    field("kind", &LoggedEvent::kind);
    field("index", &LoggedEvent::index);
    field("number", &LoggedEvent::number);
  }
};

class Executor {
 public:
  /// Checks the plan (BadInput if it is not consistent). `start` is the robot's known pose.
  Executor(genom::NameSpace& names, TemporalPlan plan, const posters::KnownPose& start);

  /// Looks up modules, requests and posters: a missing one is BadInput at its line.
  void connect();
  /// The body of the task: the plan, to its end.
  void run();
  /// From another task: run() aborts the plan and returns soon.
  void stop() { stopping_ = true; }

  const TemporalPlan& plan() const { return plan_; }
  const PlanCheck& checked() const { return checked_; }
  // While run() is active, only from tasks that cannot run concurrently with it.
  bool completed() const { return execution_.completed(); }
  /// "completed", "under way", or the reason of the abort.
  std::string end() const;
  /// Lines for people: "12.500000000 s: start of visit".
  std::vector<std::string> log() const;

 private:
  struct Sent {
    std::size_t action;
    std::uint32_t number;
    std::int32_t activity = -1;
    bool is_stopped = false;  // once its activity is known
  };

  Duration now() const { return threads::now() - origin_; }
  void connect(Request& request);
  void connect(const std::vector<Condition>& conditions);
  genom::Payload input(const Request& request) const;
  std::uint32_t send(const std::string& module, const std::string& request, const genom::Payload& input);
  bool set_up(const Request& request);
  std::optional<std::uint32_t> dispatch(const Action& action);
  void start(std::size_t action);
  void stop(std::size_t action);
  void wait(Duration until);
  void take(const genom::Reply& reply);
  void settle();
  const Condition* first_false(const std::vector<Condition>& conditions) const;
  void check_running();
  void publish();

  genom::NameSpace& names_;
  TemporalPlan plan_;
  PlanCheck checked_;
  posters::KnownPose start_;
  genom::Client client_;
  genom::Poster<LoggedEvent>& log_;
  Execution execution_;
  std::vector<Sent> sent_;
  std::size_t published_ = 0;
  Time origin_;
  std::atomic<bool> stopping_ = false;
};

}  // namespace waitpoint::plan
