// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranked_run.hpp"

#include "fibers/kernel/run.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

namespace waitpoint::run {

/// A call of the leader's, for the others.
struct RankedRun::Call {
  enum class Kind : std::uint8_t { run_before, intervene, idle, tasks, gather_records, complete, end };

  Kind kind = Kind::end;
  Time until = {};
  std::string text = {}, file = {};  // of an intervention, and where it is written
  int line = 0;
  std::optional<Time> date = {};
  Duration least = {};

  friend void carry(auto& archive, Call& call) {
    archive(call.kind, call.until, call.text, call.file, call.line, call.date, call.least);
  }
};

RankedRun::RankedRun(Ranks& ranks, const RankedParts& parts) : ranks_(ranks), parts_(parts), windows_(ranks, parts) {}

RankedRun::~RankedRun() {
  if (!ranks_.leads() || is_over_) return;
  try {
    tell({.kind = Call::Kind::end});
  } catch (const std::exception&) {  // a rank is lost, which has been reported
  }
}

// --- the leader's calls, and their execution elsewhere ---

void RankedRun::tell(const Call& call) {
  is_over_ = true;  // if it fails
  (void)ranks_.from_leader(call);
  is_over_ = false;
}

RunEnd RankedRun::run_before(Time until) {
  tell({.kind = Call::Kind::run_before, .until = until});
  return carry_on(until);
}

Time RankedRun::intervene(const Intervention& intervention, std::optional<Time> date) {
  tell({.kind = Call::Kind::intervene,
        .text = intervention.text,
        .file = intervention.written.file,
        .line = intervention.written.line,
        .date = date});
  Time at;
  ranks_.act_together([&] { at = add_intervention(intervention, date); });
  return at;
}

std::string RankedRun::idle(Duration least) {
  if (is_over_) return "";
  tell({.kind = Call::Kind::idle, .least = least});
  std::string all;
  for (const std::string& part : ranks_.gather(describe_idle(least))) all += part;
  return all;
}

std::string RankedRun::tasks() {
  if (is_over_) return "";
  tell({.kind = Call::Kind::tasks});
  std::vector<RobotTasks> all;
  for (std::vector<RobotTasks>& part : ranks_.gather(tasks_here())) std::ranges::move(part, std::back_inserter(all));
  std::ranges::sort(all, {}, &RobotTasks::robot);
  std::string lines = list_tasks(parts_.simulation.environment());
  for (const RobotTasks& of_robot : all) lines += of_robot.lines;
  return lines;
}

std::vector<RobotTasks> RankedRun::tasks_here() const {
  std::vector<RobotTasks> all;
  for (std::size_t i = 0; i < parts_.lanes.size(); ++i)
    if (is_here(i)) all.push_back({static_cast<std::uint32_t>(i), list_tasks(*parts_.lanes[i])});
  return all;
}

void RankedRun::gather_records() {
  if (is_over_) return;
  tell({.kind = Call::Kind::gather_records});
  take_over(ranks_.gather(records_here()));
}

Records RankedRun::records_here() const {
  Records own;
  own.pairs_after_ends = kernel::roster(parts_.simulation.scheduler()).pairs_after_ends();
  for (std::size_t i = 0; i < parts_.lanes.size(); ++i) {
    const kernel::Robot& lane = *parts_.lanes[i];
    if (is_here(i))
      own.robots.push_back({static_cast<std::uint32_t>(i), lane.digest, lane.outputs, lane.ended, lane.end_time});
  }
  return own;
}

void RankedRun::take_over(const std::vector<Records>& records) {
  after_ends_elsewhere_ = 0;
  for (std::size_t rank = 1; rank < records.size(); ++rank) {
    after_ends_elsewhere_ += records[rank].pairs_after_ends;
    for (const RobotRecord& record : records[rank].robots) {
      kernel::Robot& lane = *parts_.lanes[record.robot];
      lane.digest = record.digest;
      lane.outputs = record.outputs;
      lane.ended = record.ended;
      lane.end_time = record.end_time;
    }
  }
}

void RankedRun::complete(bridge::RunResult& result) {
  if (is_over_) return;
  tell({.kind = Call::Kind::complete});
  for (const Results& of_rank : ranks_.gather(Results{.figures = windows_.figures()})) {
    result.ranks.push_back(of_rank.figures);
    for (std::size_t i = 0; i < of_rank.robots.size(); ++i) {
      bridge::RobotResult& robot = result.robots[of_rank.robots[i]];
      world::Shape shape = std::move(robot.shape);
      robot = of_rank.results[i];
      robot.shape = std::move(shape);
    }
  }
}

Results RankedRun::results_here() const {
  Results own;
  own.figures = windows_.figures();
  for (std::size_t i = 0; i < parts_.robots.size(); ++i) {
    if (!is_here(i)) continue;
    own.robots.push_back(static_cast<std::uint32_t>(i));
    own.results.push_back(result_of(i));
  }
  return own;
}

void RankedRun::follow() {
  for (;;) {
    const Call call = ranks_.from_leader(Call());
    if (call.kind == Call::Kind::end) return;
    obey(call);
  }
}

void RankedRun::obey(const Call& call) {
  switch (call.kind) {
    case Call::Kind::run_before: carry_on(call.until); break;
    case Call::Kind::intervene:
      try {
        ranks_.act_together([&] {
          const scenario::Location written{call.file, call.line};
          add_intervention(parse_intervention(call.text, written), call.date);
        });
      } catch (const BadInput&) {  // the leader tells of it
      }
      break;
    case Call::Kind::idle: ranks_.gather(describe_idle(call.least)); break;
    case Call::Kind::tasks: ranks_.gather(tasks_here()); break;
    case Call::Kind::gather_records: ranks_.gather(records_here()); break;
    case Call::Kind::complete: ranks_.gather(results_here()); break;
    case Call::Kind::end: break;
  }
}

RunEnd RankedRun::carry_on(Time until) {
  is_over_ = true;  // if it fails, all ranks leave
  RunEnd end = RunEnd::time_reached;
  try {
    end = windows_.run_before(until);
  } catch (const FailedTogether&) {
    ship();
    throw;
  }
  ship();
  is_over_ = false;
  return end;
}

void RankedRun::ship() {
  for (Freight* const freight : freights_) {
    const std::vector<std::string> loads = ranks_.gather(freight->load());
    if (ranks_.leads()) freight->unload(loads);
  }
}

}  // namespace waitpoint::run
