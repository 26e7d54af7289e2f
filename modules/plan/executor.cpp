// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/executor.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/nearest_name.hpp"
#include "modules/posters/meeting.hpp"

namespace waitpoint::plan {
namespace {

constexpr Duration full_mailbox_period = std::chrono::milliseconds(1);
constexpr Duration settling_max = std::chrono::seconds(1);

std::string text(const Condition& condition) {
  static constexpr const char* words[] = {" has been written", " is at least ", " is at most ", " is "};
  std::string text = condition.poster + (condition.field.empty() ? "" : "." + condition.field) +
                     words[static_cast<std::size_t>(condition.comparison)];
  char number[32];
  std::snprintf(number, sizeof number, "%g", condition.value);
  return condition.comparison == Condition::Comparison::written ? text : text + number;
}

bool holds(const Condition& condition, double value) {
  switch (condition.comparison) {
    case Condition::Comparison::at_least: return value >= condition.value;
    case Condition::Comparison::at_most: return value <= condition.value;
    case Condition::Comparison::equals: return value == condition.value;
    default: return true;
  }
}

Request meet() { return {.module = "meeting", .name = "Meet", .input = {}, .takes_start = false, .written = {}}; }

}  // namespace

Executor::Executor(genom::NameSpace& names, TemporalPlan plan, const posters::KnownPose& start)
    : names_(names),
      plan_(std::move(plan)),
      checked_(check(plan_)),
      start_(start),
      client_(names, "plan"),
      log_(names.create_poster<LoggedEvent>("plan.log", "plan")),
      execution_(plan_) {}

void Executor::connect() {
  for (std::vector<Request>* requests : {&plan_.setup, &plan_.safe, &plan_.done})
    for (Request& request : *requests) connect(request);
  for (Action& action : plan_.actions) {
    if (action.request) connect(*action.request);
    if (action.stop) connect(*action.stop);
    connect(action.when);
    connect(action.during);
    if (action.rendezvous.empty()) continue;
    Request request = meet();
    request.written = action.written;
    connect(request);
  }
  connect(plan_.ready);
}

void Executor::connect(Request& request) {
  genom::Module* module = names_.find_module(request.module);
  std::vector<std::string_view> known;
  if (module == nullptr) {
    for (const auto& [name, each] : names_.modules()) known.emplace_back(name);
    if (request.is_to_script())
      throw request.written.bad("expected executive: {tcl: FILE} at this robot, with the procedure '" + request.name +
                                "'");
    throw request.written.bad("expected a request to a module of this robot, which has none called '" + request.module +
                              "'" + did_you_mean(request.module, known));
  }
  // Abort is a request of every module, and no procedure.
  const auto is_offered = [&](const std::string& name) { return !request.is_to_script() || name != "Abort"; };
  for (const genom::RequestType& type : module->requests())
    if (is_offered(type.name)) known.emplace_back(type.name);
  if (module->find_request(request.name) == nullptr || !is_offered(request.name))
    throw request.written.bad((request.is_to_script() ? "the script has no procedure '"
                                                      : "module '" + request.module + "' has no request '") +
                              request.name + "'" + did_you_mean(request.name, known));
  if (request.module == "meeting") return;  // its input is made here
  if (!module->find_request(request.name)->accepts(input(request)))
    throw request.written.bad("expected no input 'start' for " + request.module + "." + request.name);
}

void Executor::connect(const std::vector<Condition>& conditions) {
  for (const Condition& condition : conditions)
    if (names_.find_poster(condition.poster) == nullptr) {
      std::vector<std::string_view> known;
      for (const auto& [name, each] : names_.posters()) known.emplace_back(name);
      throw condition.written.bad("this robot has no poster '" + condition.poster + "'" +
                                  did_you_mean(condition.poster, known));
    } else if (!condition.field.empty() && !names_.find_poster(condition.poster)->has_number(condition.field)) {
      throw condition.written.bad("poster '" + condition.poster + "' has no number '" + condition.field + "'");
    }
}

genom::Payload Executor::input(const Request& request) const {
  if (request.takes_start) return genom::Payload(start_);
  genom::Settings arguments(request.input);
  return names_.find_module(request.module)->find_request(request.name)->read_input(arguments);
}

std::string Executor::end() const {
  if (completed()) return "completed";
  return execution_.failure().empty() ? "under way" : "aborted: " + execution_.failure();
}

void Executor::run() {
  origin_ = threads::now();
  for (const Request& request : plan_.setup)
    if (!set_up(request)) execution_.abort(now(), request.module + "." + request.name + " of the setup was refused");
  while (!stopping_ && execution_.failure().empty() && first_false(plan_.ready) != nullptr)
    threads::this_thread::sleep_for(plan_.poll);
  origin_ = threads::now();
  for (;;) {
    if (stopping_) execution_.abort(now(), "stopped");
    const PlanOrder order = execution_.next(now());
    publish();
    if (order.kind == PlanOrder::Kind::finish) break;
    if (order.kind == PlanOrder::Kind::start) start(order.action);
    if (order.kind == PlanOrder::Kind::stop) stop(order.action);
    if (order.kind == PlanOrder::Kind::wait) wait(order.until);
    publish();
  }
  settle();
  for (const Request& request : completed() ? plan_.done : plan_.safe)
    client_.call(request.module, request.name, input(request));
}

// Waits for room in the module's mailbox.
std::uint32_t Executor::send(const std::string& module, const std::string& request, const genom::Payload& input) {
  std::optional<std::uint32_t> number;
  while (!(number = client_.send(module, request, input))) threads::this_thread::sleep_for(full_mailbox_period);
  return *number;
}

// Waits for the first reply to a request of the setup; false if that is a refusal.
bool Executor::set_up(const Request& request) {
  const std::uint32_t number = send(request.module, request.name, input(request));
  for (;;)
    if (const std::optional<genom::Reply> reply = client_.receive(); reply->send_id == number)
      return reply->report == genom::ok;
}

std::optional<std::uint32_t> Executor::dispatch(const Action& action) {
  if (action.rendezvous.empty())
    return client_.send(action.request->module, action.request->name, input(*action.request));
  posters::Meeting with;
  with.robot = posters::ShortName(action.rendezvous);
  with.name = posters::ShortName(action.name);
  return client_.send("meeting", "Meet", with);
}

void Executor::start(std::size_t i) {
  const Action& action = plan_.actions[i];
  if (first_false(action.when) != nullptr) return execution_.postponed(i, now() + plan_.poll);
  if (!action.request && action.rendezvous.empty()) return execution_.started(i, now());
  const std::optional<std::uint32_t> number = dispatch(action);
  if (!number) return execution_.postponed(i, now() + full_mailbox_period);
  execution_.started(i, now());
  sent_.push_back({i, *number});
}

// The request in place of an abort, or the abort, which waits for the activity to begin. A request that the control
// holds back is withdrawn.
void Executor::stop(std::size_t i) {
  const auto sent = std::find_if(sent_.begin(), sent_.end(), [i](const Sent& each) { return each.action == i; });
  const Action& action = plan_.actions[i];
  if (sent != sent_.end() && sent->activity < 0) client_.withdraw(sent->number);
  if (action.stop) send(action.stop->module, action.stop->name, input(*action.stop));
  if (sent == sent_.end() || action.stop) return;
  sent->is_stopped = true;
  if (sent->activity < 0) return;
  const std::string& module = action.request ? action.request->module : meet().module;
  send(module, "Abort", genom::Payload(genom::AbortInput{sent->activity}));
}

// Until a time, a reply, or the next look at the conditions of running actions.
void Executor::wait(Duration until) {
  const bool looks = std::any_of(sent_.begin(), sent_.end(), [this](const Sent& each) {
    return execution_.is_running(each.action) && !plan_.actions[each.action].during.empty();
  });
  if (looks) until = std::min(until, now() + plan_.poll);
  const Duration stop_look = std::chrono::milliseconds(500);
  until = std::min(until, now() + stop_look);
  if (const std::optional<genom::Reply> reply = client_.receive(until - now())) take(*reply);
  if (looks) check_running();
}

// Until no request is on its way, which would run after the safe state. The bound is for a module that does not reply:
// it must not keep the robot from its safe state.
void Executor::settle() {
  const Duration until = now() + settling_max;
  const auto is_on_its_way = [](const Sent& each) { return each.activity < 0; };
  while (std::any_of(sent_.begin(), sent_.end(), is_on_its_way) && now() < until)
    if (const std::optional<genom::Reply> reply = client_.receive(until - now())) take(*reply);
}

void Executor::take(const genom::Reply& reply) {
  const auto sent =
      std::find_if(sent_.begin(), sent_.end(), [&](const Sent& each) { return each.number == reply.send_id; });
  if (sent == sent_.end()) return;
  if (reply.final) {
    const std::size_t action = sent->action;
    sent_.erase(sent);
    const std::string report = reply.report == genom::ok ? ""
                                                         : std::string("report ") + genom::name(reply.report) + " " +
                                                               std::to_string(genom::code_of(reply.report));
    return execution_.ended(action, now(), reply.report == genom::ok, report);
  }
  sent->activity = reply.activity;
  if (sent->is_stopped) stop(sent->action);
}

const Condition* Executor::first_false(const std::vector<Condition>& conditions) const {
  for (const Condition& condition : conditions) {
    FieldReading reading{.path = condition.field};
    Time date;
    if (names_.find_poster(condition.poster)->read_numbers({&reading, 1}, date) == genom::PosterStatus::empty)
      return &condition;
    const bool is_number = reading.outcome == FieldOutcome::number;
    if (!condition.field.empty() && !(is_number && holds(condition, reading.number))) return &condition;
  }
  return nullptr;
}

void Executor::check_running() {
  for (std::size_t i = 0; i < plan_.actions.size(); ++i)
    if (execution_.is_running(i))
      if (const Condition* condition = first_false(plan_.actions[i].during))
        execution_.violated(i, now(), "expected that " + text(*condition));
}

void Executor::publish() {
  for (; published_ < execution_.log().size(); ++published_) {
    const Event& event = execution_.log()[published_];
    log_.write({origin_ + event.time, event.kind, static_cast<std::uint32_t>(event.index),
                static_cast<std::uint32_t>(published_)});
  }
}

std::vector<std::string> Executor::log() const {
  static constexpr const char* words[] = {"start of ", "stop of ",     "end of ",          "early: ",   "late: ",
                                          "failed: ",  "alternative ", "repaired: after ", "completed", "aborted"};
  std::vector<std::string> lines;
  for (const Event& event : execution_.log()) {
    std::string line = to_string(origin_ + event.time) + " s: " + words[static_cast<std::size_t>(event.kind)];
    if (event.kind == EventKind::branch)
      line += "'" + plan_.alternatives[event.index].name + "', branch " + event.detail;
    else if (event.kind != EventKind::completed && event.kind != EventKind::aborted)
      line += plan_.actions[event.index].name;
    if (event.kind == EventKind::failed) line += ": " + event.detail;
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace waitpoint::plan
