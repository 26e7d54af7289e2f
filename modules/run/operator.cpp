// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/operator.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/sync/thread.hpp"
#include "modules/genom/client.hpp"

namespace waitpoint::run {
namespace {

constexpr std::uint64_t by_the_operator = 0x6F70657261746F72;  // "operator"

std::string placed(const std::optional<std::string>& in_the_way) {
  return in_the_way ? "refused, '" + *in_the_way + "' is in the way" : "done";
}

std::string no_obstacle(const std::string& name) { return "refused, there is no obstacle '" + name + "'"; }

[[noreturn]] void unknown(const scenario::Location& written, const std::string& what, const std::string& name,
                          const std::vector<std::string_view>& known) {
  throw written.bad("there is no " + what + " '" + name + "'" + did_you_mean(name, known));
}

}  // namespace

Time Operator::add(Intervention intervention, std::optional<Time> wanted) {
  const Time date = step_for(intervention, wanted);
  if (added_ == interventions_max && !is_frequent(intervention))
    throw intervention.written.bad("more than " + std::to_string(interventions_max) + " interventions in a run");
  check(intervention);
  if (!is_frequent(intervention)) ++added_;
  const auto place = std::upper_bound(planned_.begin(), planned_.end(), date,
                                      [](Time time, const Planned& other) { return time < other.date; });
  planned_.insert(place, {date, std::move(intervention)});
  return date;
}

Time Operator::step_for(const Intervention& intervention, std::optional<Time> date) const {
  const Duration step = world_.description().step;
  const Time next = Time() + step * static_cast<std::int64_t>(world_.steps() + 1);
  if (date && *date < next)
    throw intervention.written.bad("expected a time from " + to_string(next) + " s on, the world's next step, found " +
                                   to_string(*date) + " s");
  const std::int64_t steps = date ? (date->since_start() + step - Duration::from_ns(1)) / step : 0;
  return date ? Time() + step * steps : next;
}

void Operator::act(Time now) {
  now_ = now;
  while (!planned_.empty() && planned_.front().date <= now) {
    const Intervention intervention = std::move(planned_.front().intervention);
    planned_.pop_front();
    const std::string outcome = intervention.text + ": " + carry_out(intervention);
    if (!is_frequent(intervention)) outcomes_.push_back({now, outcome});
    Digest digest;
    digest.add(std::string_view(outcome));
    kernel::record_output(by_the_operator, digest.value());
  }
  for (const auto& [robot, external] : external_) external->before_step(now);
}

// --- checks at submission ---

void Operator::check(const Intervention& intervention) {
  if (const auto* request = std::get_if<ModuleRequest>(&intervention.what)) check(*request, intervention.written);
  if (const auto* move = std::get_if<RobotMove>(&intervention.what))
    (void)bridge::index_of(move->robot, robots_, intervention.written);
  if (const auto* command = std::get_if<ShellCommand>(&intervention.what)) check(*command, intervention.written);
  if (const auto* external = std::get_if<ExternalDeclaration>(&intervention.what))
    check(*external, intervention.written);
  if (const auto* report = std::get_if<ExternalReport>(&intervention.what)) check(*report, intervention.written);
  if (const auto* command = std::get_if<DriveCommand>(&intervention.what))
    (void)bridge::index_of(command->robot, robots_, intervention.written);
  if (const auto* pose = std::get_if<PublishedPose>(&intervention.what))
    (void)bridge::index_of(pose->robot, robots_, intervention.written);
  if (const auto* end = std::get_if<GoalEnd>(&intervention.what))
    (void)bridge::index_of(end->robot, robots_, intervention.written);
}

void Operator::check(const ExternalDeclaration& external, const scenario::Location& written) {
  const std::size_t robot = bridge::index_of(external.robot, robots_, written);
  if (world_.description().engine == world::Engine::bullet)
    throw written.bad(
        "expected engine fcl or slice for a robot outside: bodies of a dynamic world are moved by forces");
  if (!external_declared_.insert(robot).second) throw written.bad("'" + external.robot + "' is external already");
}

void Operator::check(const ExternalReport& report, const scenario::Location& written) const {
  if (!external_declared_.contains(bridge::index_of(report.robot, robots_, written)))
    throw written.bad("'" + report.robot + "' is no external robot: expected 'external " + report.robot + "' before");
}

void Operator::check(const ShellCommand& command, const scenario::Location& written) const {
  const bridge::Robot& owner = *robots_[bridge::index_of(command.robot, robots_, written)];
  if (owner.presence() == bridge::Presence::elsewhere)
    throw written.bad("expected a robot of this process: '" + command.robot + "' is of another rank");
  (void)tcl::library(written.file, written.line);
}

void Operator::check(const ModuleRequest& request, const scenario::Location& written) const {
  bridge::Robot& owner = *robots_[bridge::index_of(request.robot, robots_, written)];
  if (owner.presence() == bridge::Presence::elsewhere) return;
  const genom::Module* module = owner.names().find_module(request.module);
  if (module == nullptr) {
    std::vector<std::string_view> known;
    for (const auto& [name, entry] : owner.names().modules()) known.push_back(name);
    unknown(written, "module", request.module, known);
  }
  const genom::RequestType* type = module->find_request(request.request);
  if (type == nullptr) {
    std::vector<std::string_view> known;
    for (const genom::RequestType& other : module->requests()) known.push_back(other.name);
    unknown(written, "request", request.request, known);
  }
  genom::Settings arguments(request.arguments);
  (void)type->read_input(arguments);
}

// --- execution ---

std::string Operator::carry_out(const Intervention& intervention) {
  return std::visit([&](const auto& what) { return carry_out(what, intervention); }, intervention.what);
}

std::string Operator::carry_out(const ModuleRequest& request, const Intervention& whole) {
  const std::size_t index = bridge::index_of(request.robot, robots_, whole.written);
  bridge::Robot& owner = *robots_[index];
  if (owner.presence() == bridge::Presence::elsewhere) return "sent";
  genom::Settings arguments(request.arguments);
  const genom::Payload input =
      owner.names().find_module(request.module)->find_request(request.request)->read_input(arguments);
  auto ask = [this, &owner, request, input, text = whole.text] {
    genom::Client client(owner.names(), "operator");
    const genom::Reply reply = client.call(request.module, request.request, input);
    outcomes_.push_back({now(), text + ": " + tcl::text_of(reply.report), true});
  };
  kernel::Robot& lane = *lanes_[index];
  sync::start_thread(*lane.scheduler, lane, {.name = "operator", .service = true}, sync::make_call(std::move(ask)));
  return "sent";
}

std::string Operator::carry_out(const ShellCommand& command, const Intervention& whole) {
  const std::size_t index = bridge::index_of(command.robot, robots_, whole.written);
  std::unique_ptr<tcl::Shell>& shell = shells_[index];
  if (shell == nullptr) {
    shell = std::make_unique<tcl::Shell>(
        robots_[index]->names(), tcl::library(whole.written.file, whole.written.line), command.robot,
        [this, robot = command.robot](Time date, const std::string& text, bool is_result) {
          outcomes_.push_back({date, "tcl " + robot + ": " + text, is_result});
        });
    kernel::Robot& lane = *lanes_[index];
    sync::start_thread(*lane.scheduler, lane, {.name = "tcl", .stack = kernel::StackSize::program, .service = true},
                       sync::make_call([&shell = *shell] { shell.run(); }));
  }
  shell->submit(command.command);
  return "sent";
}

std::string Operator::carry_out(const ExternalDeclaration& external, const Intervention& whole) {
  const std::size_t robot = bridge::index_of(external.robot, robots_, whole.written);
  external_[robot] = std::make_unique<ExternalRobot>(world_, world::BodyId(robot), external.settings, now_,
                                                     [this, name = external.robot](Time date, const std::string& text) {
                                                       outcomes_.push_back({date, text, false, name});
                                                     });
  return "done";
}

std::string Operator::carry_out(const ExternalReport& report, const Intervention& whole) {
  const auto external = external_.find(bridge::index_of(report.robot, robots_, whole.written));
  if (external == external_.end()) return "refused, the robot is not external yet";
  external->second->take(report.report, now_);
  return "done";
}

std::string Operator::carry_out(const DriveCommand& command, const Intervention& whole) {
  world_.command(world::BodyId(bridge::index_of(command.robot, robots_, whole.written)), command.velocity);
  return "done";
}

std::string Operator::carry_out(const PublishedPose& published, const Intervention& whole) {
  bridge::Robot& robot = *robots_[bridge::index_of(published.robot, robots_, whole.written)];
  const bool is_taken = robot.presence() == bridge::Presence::here && robot.bridge().take(published.pose);
  return is_taken ? "done" : "ignored: no poster of the robot is filled from the topic 'pose'";
}

// Streams have no state but these seeds; links and programs that begin later ask the chooser for its own.
std::string Operator::carry_out(const SeedChange& change, const Intervention&) {
  kernel::chooser(*kernel::running->scheduler).reseed(change.seed);
  network_.reseed();
  world_.reseed(change.seed);
  for (const auto& robot : robots_) robot->reseed(change.seed);
  return "done";
}

std::string Operator::carry_out(const GoalEnd& end, const Intervention& whole) {
  const bool taken = robots_[bridge::index_of(end.robot, robots_, whole.written)]->end_goal(end.is_reached);
  return taken ? "done" : "refused, it has no goal that others drive to";
}

std::optional<bridge::ExternalFigures> Operator::external_figures(std::size_t robot) const {
  const auto external = external_.find(robot);
  return external == external_.end() ? std::nullopt : std::optional(external->second->figures());
}

std::string Operator::carry_out(const RobotMove& move, const Intervention& whole) {
  return placed(world_.move_body(world::BodyId(bridge::index_of(move.robot, robots_, whole.written)), move.pose));
}

std::string Operator::carry_out(const ObstacleMove& move, const Intervention&) {
  for (const world::Obstacle& obstacle : world_.description().obstacles) {
    if (obstacle.name != move.name) continue;
    world::Obstacle moved = obstacle;
    moved.shape.pose = move.pose;
    return placed(world_.put_obstacle(moved));
  }
  return no_obstacle(move.name);
}

std::string Operator::carry_out(const ObstaclePut& put, const Intervention&) {
  return placed(world_.put_obstacle(put.obstacle));
}

std::string Operator::carry_out(const ObstacleRemoval& removal, const Intervention&) {
  return world_.remove_obstacle(removal.name) ? "done" : no_obstacle(removal.name);
}

std::string Operator::carry_out(const Push& push, const Intervention&) {
  const std::optional<std::string> why_not = world_.push(push.name, push.force_n, push.time);
  return why_not ? "refused, " + *why_not : "done";
}

}  // namespace waitpoint::run
