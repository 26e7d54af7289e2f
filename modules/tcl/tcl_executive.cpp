// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/tcl_executive.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "core/field_text.hpp"
#include "core/number_text.hpp"

namespace waitpoint::tcl {
namespace {

constexpr Duration full_mailbox_period = std::chrono::milliseconds(1);

void write_line(const std::string& robot, Time date, const std::string& line) {
  std::fprintf(stderr, "%10.3f s  %s: %s\n", date.seconds(), robot.c_str(), line.c_str());
}

bool read_point(const std::vector<std::string>& words, Point& point) {
  return words.size() == 2 && parse_number(words[0], point.x) && parse_number(words[1], point.y);
}

// The trace without the message, with which it begins: its lines behind one another.
std::string levels_of(const ScriptEnd& outcome) {
  std::string_view rest = outcome.trace;
  rest.remove_prefix(std::min(rest.size(), outcome.text.size()));
  std::string levels;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (const std::size_t start = line.find_first_not_of(' '); start != std::string_view::npos)
      levels.append(" ").append(line.substr(start));
  }
  return levels;
}

// The place, the message and the levels of an error.
std::string error_of(const std::string& file, const ScriptEnd& outcome) {
  return file + ":" + std::to_string(outcome.line) + ": " + outcome.text + levels_of(outcome);
}

// Of rand().
std::uint32_t seed_of_script(const RandomStream& random) { return random.block(0)[0]; }

// Null if the robot has none.
Procedures* procedures_among(const genom::NameSpace& names) {
  for (const auto& [name, module] : names.modules())
    if (auto* const procedures = dynamic_cast<Procedures*>(module)) return procedures;
  return nullptr;
}

std::string list_of(const std::vector<Point>& points) { return waitpoint::text_of(points); }

}  // namespace

TclExecutive::TclExecutive(const executive::ExecutiveSetup& setup)
    : ModuleLink(
          setup.names, setup.robot, "executive",
          [robot = setup.robot](Time date, const std::string& line) { write_line(robot, date, line); },
          setup.script->folders),
      setup_(setup),
      library_(library_for(setup.script->file, setup.script->text, setup.script->named_in, setup.script->named_at)),
      planner_(setup.known, setup.parameters.planning),
      looks_(setup.parameters.mark_range_m),
      procedures_(procedures_among(setup.names)) {
  if (procedures_ != nullptr) procedures_->set_wake([this] { client().wake(); });
  for (const Point goal : setup_.goals) {
    goals_.emplace_back();
    goals_.back().goal = goal;
    goals_.back().visits = 1;
  }
}

// A script may do without position and laser.
void TclExecutive::connect() {
  can_look_ = names().find_poster("pom.position") != nullptr && names().find_poster("sick.echoes") != nullptr;
  if (can_look_) looks_.connect(names());
}

void TclExecutive::run() {
  const std::unique_ptr<Interpreter> interpreter = library_.make(*this, seed_of_script(setup_.random), &threads::now);
  interpreter_ = interpreter.get();
  const std::unique_ptr<Interpreter*, void (*)(Interpreter**)> until_the_end(
      &interpreter_, [](Interpreter** running) { *running = nullptr; });
  try {
    const ScriptEnd outcome = interpreter->run(setup_.script->file, setup_.script->text);
    if (!outcome.ok) throw std::runtime_error(error_of(setup_.script->file, outcome));
    if (procedures_ != nullptr) serve(*interpreter);
  } catch (const Stopped&) {
    if (procedures_ == nullptr) stop_modules();
  }
}

void TclExecutive::reseed(const RandomStream& random) {
  setup_.random = random;
  if (interpreter_ != nullptr) interpreter_->reseed(seed_of_script(random));
}

// The calls of procedures, until stop().
void TclExecutive::serve(Interpreter& interpreter) {
  for (;;) {
    check_stop();
    const std::optional<std::string> command = procedures_->begin();
    if (!command) {
      take(Duration::max());
      continue;
    }
    running_.clear();
    try {
      const ScriptEnd outcome = interpreter.evaluate(*command);
      if (!outcome.ok) say(error_of(setup_.script->file, outcome));
      if (outcome.exited) say(setup_.script->file + ": exit, in place of a procedure's end, in: " + *command);
      procedures_->end(outcome.ok && !outcome.exited);
    } catch (const Interrupted&) {
      abort_requests();
      procedures_->end(false);
    } catch (const Stopped&) {
      abort_requests();
      throw;
    }
  }
}

void TclExecutive::stop() {
  stopping_ = true;
  client().wake();
}

void TclExecutive::check_stop() const {
  if (stopping_) throw Stopped();
  if (procedures_ != nullptr && procedures_->is_interrupted()) throw Interrupted();
}

// Ends the activities of running_, and waits for their ends.
void TclExecutive::abort_requests() {
  for (const auto& [number, request] : running_)
    if (request.activity < 0) withdraw(number);
  while (!running_.empty()) {
    bool is_full = false;
    for (auto& [number, request] : running_) {
      if (request.is_aborted || request.activity < 0) continue;
      request.is_aborted = client().send(request.module, "Abort", genom::AbortInput{request.activity}).has_value();
      is_full = is_full || !request.is_aborted;
    }
    take(is_full ? full_mailbox_period : Duration::max());
  }
}

void TclExecutive::stop_modules() {
  for (const auto& [name, module] : names().modules())
    if (const genom::RequestType* type = module->find_request("Stop");
        type != nullptr && type->accepts(genom::Payload()))
      client().call(name, "Stop");
}

// All but the one that this task serves.
std::vector<std::string> TclExecutive::modules() const {
  std::vector<std::string> all = ModuleLink::modules();
  if (procedures_ != nullptr) std::erase(all, procedures_->name());
  return all;
}

Answer TclExecutive::send(const std::string& module, const std::string& request, const std::vector<Setting>& input) {
  Answer answer = ModuleLink::send(module, request, input);
  if (answer.ok) running_[answer.id].module = module;
  return answer;
}

// Waits for a reply, a call, an interruption or stop(); false after the timeout.
bool TclExecutive::take(Duration timeout) {
  const std::optional<ReplyText> reply = ModuleLink::receive(timeout);
  if (!reply) return false;
  if (reply->id == 0) return true;
  replies_.push_back(*reply);
  const auto request = running_.find(reply->id);
  if (request == running_.end()) return true;
  request->second.activity = reply->activity;
  if (reply->final) running_.erase(request);
  return true;
}

std::optional<ReplyText> TclExecutive::receive(Duration timeout) {
  const Time now = threads::now(), end = timeout == Duration::max() ? Time::max() : now + timeout;
  if (timeout > Duration()) check_stop();
  while (replies_.empty()) {
    if (!take(end == Time::max() ? timeout : end - threads::now())) return std::nullopt;
    if (timeout > Duration()) check_stop();
  }
  ReplyText reply = std::move(replies_.front());
  replies_.pop_front();
  return reply;
}

void TclExecutive::sleep_until(Time time) {
  check_stop();
  while (threads::now() < time) {
    take(time - threads::now());
    check_stop();
  }
}

std::vector<std::string> TclExecutive::commands() const {
  return {"goals", "reached", "missed", "start", "position", "plan", "look", "mark", "forget", "compute"};
}

Answer TclExecutive::carry_out(const std::string& command, const std::vector<std::string>& words) {
  if (command == "goals") return {true, list_of(setup_.goals)};
  if (command == "reached") return finish_goal(words, executive::GoalState::reached);
  if (command == "missed") return finish_goal(words, executive::GoalState::given_up);
  if (command == "start") return {true, waitpoint::text_of(setup_.start.pose)};
  if (command == "compute") {
    std::int64_t us = 0;
    constexpr std::int64_t us_max = 1'000'000'000'000;
    if (words.size() != 1 || !parse_number(words[0], us) || us < 0 || us > us_max)
      return {false, "expected a number of microseconds"};
    threads::compute(std::chrono::microseconds(us));
    return {};
  }
  if (command == "forget") {
    planner_.space().forget();
    looks_.clear();
    return {};
  }
  if (!can_look_) return {false, "waitpoint::" + command + " needs the posters pom.position and sick.echoes"};
  if (command == "plan") return plan(words);
  if (!looks_.have_begun()) return {false, "the posters pom.position and sick.echoes are still empty"};
  if (command == "position") return {true, waitpoint::text_of(looks_.position())};
  if (command == "look")
    looks_.look();
  else
    planner_.space().mark(looks_.seen());
  return {};
}

Answer TclExecutive::finish_goal(const std::vector<std::string>& words, executive::GoalState state) {
  std::size_t number = 0;
  if (words.size() != 1 || !parse_number(words[0], number) || number >= goals_.size())
    return {false, "expected the number of a goal, less than " + std::to_string(goals_.size())};
  executive::GoalRecord& goal = goals_[number];
  goal.state = state;
  goal.date = threads::now();
  goal.times_reached = state == executive::GoalState::reached ? 1 : 0;
  return {};
}

Answer TclExecutive::plan(const std::vector<std::string>& words) {
  Point goal;
  if (!read_point(words, goal)) return {false, "expected a point, X Y"};
  executive::RoutePlan plan;
  planner_.plan(looks_.position(), goal, plan);
  threads::compute(setup_.parameters.plan_cost_us);
  if (plan.outcome != executive::PlanOutcome::found) return {false, executive::to_string(plan.outcome)};
  return {true, list_of(plan.via_points)};
}

std::size_t TclExecutive::current_goal() const {
  const auto is_ahead = [](const auto& goal) { return goal.state == executive::GoalState::ahead; };
  return static_cast<std::size_t>(std::find_if(goals_.begin(), goals_.end(), is_ahead) - goals_.begin());
}

}  // namespace waitpoint::tcl
