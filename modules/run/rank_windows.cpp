// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/rank_windows.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "fibers/io/letter.hpp"
#include "fibers/kernel/messages.hpp"
#include "fibers/kernel/run.hpp"
#include "modules/run/ranks/processor_time.hpp"

namespace waitpoint::run {
namespace {

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

RunEnd end_of(Failure::Kind kind) { return kind == Failure::Kind::deadlock ? RunEnd::deadlock : RunEnd::no_progress; }

}  // namespace

RankWindows::RankWindows(Ranks& ranks, const RankedParts& parts)
    : ranks_(ranks), parts_(parts), remote_steps_(parts.robots.size()), reported_(parts.robots.size()) {
  ranks.set_place([this] {
    return "in window " + std::to_string(windows_ + 1) + ", from " + to_string(reached_) + " s of virtual time on";
  });
  send_elsewhere();
  for (std::size_t i = 0; i < parts.robots.size(); ++i) {
    reported_[i].robot = static_cast<std::uint32_t>(i);
    if (is_here(i)) parts.robots[i]->bridge().set_command_log(commands_);
  }
}

void RankWindows::send_elsewhere() {
  std::set<std::string, std::less<>> elsewhere;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i)
    if (!is_here(i)) elsewhere.insert(parts_.robots[i]->name());
  parts_.network.set_elsewhere(
      std::move(elsewhere), [this](const kernel::Robot& sender, std::uint64_t count, Time arrives,
                                   const std::string& to, const io::Packet& packet) {
        const std::vector<std::byte> bytes = io::to_bytes(packet);
        messages_.push_back(
            {sender.name, to, count, arrives, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
      });
}

Time RankWindows::end_of_window() const {
  const Time begun = parts_.steps.last(reached_), step = parts_.steps.next(reached_);
  const Duration lookahead = kernel::lookahead(parts_.simulation.scheduler());
  if (lookahead >= parts_.steps.period()) return step;
  return std::min(step, begun + lookahead * ((reached_ - begun) / lookahead + 1));
}

RunEnd RankWindows::run_before(Time until) {
  RunEnd end = RunEnd::time_reached;
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
  return end;
}

Window RankWindows::run_window(Time end) {
  commands_.clear();
  messages_.clear();
  Window window;
  window.failure = failure_in(end);
  window.live_tasks = kernel::roster(parts_.simulation.scheduler()).live_tasks();
  window.last_end = last_end_here_;
  window.environment = parts_.simulation.environment().digest.value();
  bodies_.clear();
  Digest bodies;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i)
    bodies.add(bodies_.emplace_back(io::hash_of(parts_.world.body(world::BodyId(i)))));
  window.bodies = bodies.value();
  window.commands = commands_;
  window.messages = messages_;
  for (std::size_t i = 0; i < parts_.robots.size(); ++i) {
    if (!is_here(i)) continue;
    const GoalCounts now{reported_[i].robot, parts_.robots[i]->goals(), parts_.robots[i]->goals_reached()};
    if (windows_ > 0 && now == reported_[i]) continue;
    window.goals.push_back(now);
    reported_[i] = now;
  }
  const std::vector<InterventionOutcome>& outcomes = parts_.the_operator.outcomes();
  for (; seen_outcomes_ < outcomes.size(); ++seen_outcomes_)
    if (outcomes[seen_outcomes_].is_reply && !ranks_.leads()) window.replies.push_back(outcomes[seen_outcomes_]);
  if (windows_ == 0) note_steps(window);
  return window;
}

Failure RankWindows::failure_in(Time end) {
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
void RankWindows::note_steps(Window& window) const {
  const kernel::Task* task = kernel::first_task(parts_.simulation.scheduler());
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
RunEnd RankWindows::take_over(const std::vector<Window>& windows, Time end) {
  reached_ = end;
  ++windows_;
  std::uint64_t live_tasks = 0;
  std::optional<Time> last_end;
  for (std::size_t rank = 0; rank < windows.size(); ++rank) {
    const Window& window = windows[rank];
    if (window.failure.kind == Failure::Kind::exception) throw FailedTogether(window.failure.text);
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
      if (!parts_.network.is_elsewhere(message.to))
        parts_.network.arrive_at(message.arrives, message.sender, message.count, message.to,
                                 io::packet_of(std::as_bytes(std::span(message.packet))));
    for (const StepNumber& step : window.steps) remote_steps_[step.robot].adopt(*parts_.lanes[step.robot], step.number);
    if (ranks_.leads())
      for (const InterventionOutcome& reply : window.replies) parts_.the_operator.add_reply(reply);
  }
  check_replicas(windows, end);
  last_end_ = live_tasks == 0 ? last_end : std::nullopt;
  return live_tasks == 0 && last_end_ && parts_.steps.contain(end) ? RunEnd::ended : RunEnd::time_reached;
}

void RankWindows::check_replicas(const std::vector<Window>& windows, Time end) {
  std::size_t other = 1;
  const auto is_same = [&](const Window& window) {
    return window.environment == windows[0].environment && window.bodies == windows[0].bodies;
  };
  while (other < windows.size() && is_same(windows[other])) ++other;
  if (other == windows.size()) return;
  const std::vector<std::vector<std::uint64_t>> all = ranks_.gather(bodies_);
  std::string what = "the environment's events differ";
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (all[other][i] != all[0][i]) {
      what = "the state of body '" + parts_.robots[i]->name() + "' differs";
      break;
    }
  throw FailedTogether("rank " + std::to_string(other) + " is not equal to rank 0 after window " +
                       std::to_string(windows_) + ", which ends at " + to_string(end) + " s: " + what);
}

}  // namespace waitpoint::run
