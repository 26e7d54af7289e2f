// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranked_run.hpp"

#include <exception>
#include <utility>

namespace waitpoint::run {

/// A call of the leader's, for the others.
struct RankedRun::Call {
  enum class Kind : std::uint8_t { run_before, intervene, idle, gather_records, complete, end };

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

void RankedRun::gather_records() {
  if (is_over_) return;
  if (ranks_.leads()) tell({.kind = Call::Kind::gather_records});
  Records own;
  own.pairs_after_ends = parts_.simulation.scheduler().roster().pairs_after_ends();
  for (std::size_t i = 0; i < parts_.lanes.size(); ++i) {
    const kernel::Robot& lane = *parts_.lanes[i];
    if (is_here(i))
      own.robots.push_back({static_cast<std::uint32_t>(i), lane.digest, lane.outputs, lane.ended, lane.end_time});
  }
  after_ends_elsewhere_ = 0;
  const std::vector<Records> all = ranks_.gather(own);
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (rank == static_cast<std::size_t>(ranks_.rank())) continue;
    after_ends_elsewhere_ += all[rank].pairs_after_ends;
    for (const RobotRecord& record : all[rank].robots) {
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
  if (ranks_.leads()) tell({.kind = Call::Kind::complete});
  Results own;
  own.figures = windows_.figures();
  for (std::size_t i = 0; i < parts_.robots.size(); ++i) {
    if (!is_here(i) || ranks_.leads()) continue;
    own.robots.push_back(static_cast<std::uint32_t>(i));
    own.results.push_back(result_of(i));
  }
  for (const Results& of_rank : ranks_.gather(own)) {
    result.ranks.push_back(of_rank.figures);
    for (std::size_t i = 0; i < of_rank.robots.size() && ranks_.leads(); ++i) {
      bridge::RobotResult& robot = result.robots[of_rank.robots[i]];
      world::Shape shape = std::move(robot.shape);
      robot = of_rank.results[i];
      robot.shape = std::move(shape);
    }
  }
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
    case Call::Kind::gather_records: gather_records(); break;
    case Call::Kind::complete: {
      bridge::RunResult none;
      complete(none);
      break;
    }
    case Call::Kind::end: break;
  }
}

RunEnd RankedRun::carry_on(Time until) {
  is_over_ = true;  // if it fails, all ranks leave
  const RunEnd end = windows_.run_before(until);
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
