// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranks/ranked_run.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/fields.hpp"
#include "modules/run/ranks/processor_time.hpp"

namespace waitpoint::run {
namespace {

std::uint64_t hash_of(const world::BodyState& body) {
  Digest digest;
  add_value(digest, body);
  return digest.value();
}

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

RunEnd end_of(Failure::Kind kind) { return kind == Failure::Kind::deadlock ? RunEnd::deadlock : RunEnd::no_progress; }

}  // namespace

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

RankedRun::RankedRun(Ranks& ranks, const RankedParts& parts)
    : ranks_(ranks), parts_(parts), remote_steps_(parts.robots.size()), told_(parts.robots.size()) {
  ranks.set_place([this] {
    return "in window " + std::to_string(windows_ + 1) + ", from " + to_string(reached_) + " s of virtual time on";
  });
  send_elsewhere();
  for (std::size_t i = 0; i < parts.robots.size(); ++i) {
    told_[i].robot = static_cast<std::uint32_t>(i);
    if (is_here(i)) parts.robots[i]->bridge().set_command_log(commands_);
  }
}

RankedRun::~RankedRun() {
  if (!ranks_.leads() || is_over_) return;
  try {
    tell({.kind = Call::Kind::end});
  } catch (const std::exception&) {  // a rank is lost, which has been reported
  }
}

void RankedRun::send_elsewhere() {
  std::set<std::string, std::less<>> elsewhere;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i)
    if (!is_here(i)) elsewhere.insert(parts_.robots[i]->name());
  parts_.network.set_elsewhere(std::move(elsewhere), [this](const kernel::Robot& sender, std::uint64_t count,
                                                            Time arrives, const std::string& to, io::Packet packet) {
    const std::vector<std::byte> bytes = io::to_bytes(packet);
    messages_.push_back(
        {sender.name, to, count, arrives, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
  });
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
  own.figures = figures_;
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

// --- windows ---

Time RankedRun::end_of_window() const {
  const Duration begun = parts_.step * (reached_.since_start() / parts_.step);
  const Duration lookahead = parts_.simulation.scheduler().lookahead();
  const Time step = Time() + begun + parts_.step;
  if (lookahead >= parts_.step) return step;
  return std::min(step, Time() + begun + lookahead * ((reached_.since_start() - begun) / lookahead + 1));
}

RunEnd RankedRun::carry_on(Time until) {
  RunEnd end = RunEnd::time_reached;
  is_over_ = true;  // if it fails, all ranks leave
  while (end == RunEnd::time_reached && reached_ < until) {
    const Time next = std::min(until, end_of_window());
    const double begin_s = processor_s();
    const Window own = run_window(next);
    figures_.computing_s += processor_s() - begin_s;
    const double wait_s = wall_s();
    const std::vector<Window> all = ranks_.gather(own);
    figures_.exchange_s += wall_s() - wait_s;
    end = take_over(all, next);
  }
  ship();
  is_over_ = false;
  return end;
}

Window RankedRun::run_window(Time end) {
  commands_.clear();
  messages_.clear();
  Window window;
  window.failure = failure_in(end);
  window.live_tasks = parts_.simulation.scheduler().roster().live_tasks();
  window.last_end = last_end_here_;
  window.environment = parts_.simulation.environment().digest.value();
  Digest bodies;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i) bodies.add(hash_of(parts_.world.body(world::BodyId(i))));
  window.bodies = bodies.value();
  window.commands = commands_;
  window.messages = messages_;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i) {
    if (!is_here(i)) continue;
    const GoalCounts now{told_[i].robot, parts_.robots[i]->goals(), parts_.robots[i]->goals_reached()};
    if (windows_ > 0 && now == told_[i]) continue;
    window.goals.push_back(now);
    told_[i] = now;
  }
  const std::vector<InterventionOutcome>& outcomes = parts_.the_operator.outcomes();
  for (; seen_outcomes_ < outcomes.size(); ++seen_outcomes_)
    if (outcomes[seen_outcomes_].is_reply && !ranks_.leads()) window.replies.push_back(outcomes[seen_outcomes_]);
  if (windows_ == 0) note_steps(window);
  return window;
}

Failure RankedRun::failure_in(Time end) {
  Simulation& simulation = parts_.simulation;
  try {
    RunEnd stopped = simulation.run_before(end);
    for (; stopped == RunEnd::ended && simulation.go_on_with_services(); stopped = simulation.run_before(end))
      last_end_here_ = simulation.global_time();
    if (stopped == RunEnd::deadlock || stopped == RunEnd::no_progress)
      return {stopped == RunEnd::deadlock ? Failure::Kind::deadlock : Failure::Kind::no_progress, simulation.trouble()};
  } catch (...) {
    return {Failure::Kind::exception, simulation.trouble()};
  }
  return {};
}

// Since the first window each bridge waits for the world's step.
void RankedRun::note_steps(Window& window) const {
  const kernel::Task* task = parts_.simulation.scheduler().first_task();
  for (; task != nullptr; task = task->next) {
    if (task->phase != kernel::Phase::world || task->blocked_on == nullptr ||
        task->blocked_on->label != std::string_view(step_label))
      continue;
    const auto lane = std::find(parts_.lanes.begin(), parts_.lanes.end(), task->robot);
    if (lane != parts_.lanes.end())
      window.steps.push_back({static_cast<std::uint32_t>(lane - parts_.lanes.begin()), task->blocked_on->number});
  }
}

// All ranks come to the same result.
RunEnd RankedRun::take_over(const std::vector<Window>& windows, Time end) {
  reached_ = end;
  ++windows_;
  std::uint64_t live_tasks = 0;
  std::optional<Time> last_end;
  for (std::size_t rank = 0; rank < windows.size(); ++rank) {
    const Window& window = windows[rank];
    if (window.failure.kind == Failure::Kind::exception) throw std::runtime_error(window.failure.text);
    if (window.failure.kind != Failure::Kind::none) {
      trouble_ = window.failure.text;
      return end_of(window.failure.kind);
    }
    live_tasks += window.live_tasks;
    last_end = std::max(last_end, window.last_end);
    if (rank == static_cast<std::size_t>(ranks_.rank())) continue;
    for (const bridge::BodyCommand& command : window.commands) parts_.world.command(command.body, command.velocity);
    for (const GoalCounts& goals : window.goals) parts_.robots[goals.robot]->set_goals(goals.goals, goals.reached);
    for (const Message& message : window.messages)
      if (is_here(bridge::index_of(message.to, parts_.robots, {})))
        parts_.network.arrive_at(message.arrives, message.sender, message.count, message.to,
                                 io::packet_of(std::as_bytes(std::span(message.packet))));
    for (const StepNumber& step : window.steps) remote_steps_[step.robot].adopt(*parts_.lanes[step.robot], step.number);
    if (ranks_.leads())
      for (const InterventionOutcome& reply : window.replies) parts_.the_operator.add_reply(reply);
  }
  check_replicas(windows, end);
  last_end_ = live_tasks == 0 ? last_end : std::nullopt;
  const bool is_whole_step = end == Time() + parts_.step * (end.since_start() / parts_.step);
  return live_tasks == 0 && last_end_ && is_whole_step ? RunEnd::ended : RunEnd::time_reached;
}

void RankedRun::check_replicas(const std::vector<Window>& windows, Time end) {
  std::size_t other = 1;
  const auto is_same = [&](const Window& window) {
    return window.environment == windows[0].environment && window.bodies == windows[0].bodies;
  };
  while (other < windows.size() && is_same(windows[other])) ++other;
  if (other == windows.size()) return;
  std::vector<std::uint64_t> own;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i) own.push_back(hash_of(parts_.world.body(world::BodyId(i))));
  const std::vector<std::vector<std::uint64_t>> all = ranks_.gather(own);
  std::string what = "the environment's events differ";
  for (std::size_t i = 0; i < own.size(); ++i)
    if (all[other][i] != all[0][i]) {
      what = "the state of body '" + parts_.robots[i]->name() + "' differs";
      break;
    }
  throw std::runtime_error("rank " + std::to_string(other) + " is not equal to rank 0 after window " +
                           std::to_string(windows_) + ", which ends at " + to_string(end) + " s: " + what);
}

void RankedRun::ship() {
  for (Freight* const freight : freights_) {
    const std::vector<std::string> loads = ranks_.gather(freight->load());
    if (ranks_.leads()) freight->unload(loads);
  }
}

}  // namespace waitpoint::run
