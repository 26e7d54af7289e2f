// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/run_copy.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <system_error>

#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "modules/run/journal.hpp"
#include "tools/output/recorders.hpp"
#include "tools/view/event_trace.hpp"
#include "tools/view/history/private_files.hpp"
#include "tools/view/poster_plots.hpp"
#include "tools/view/request.hpp"
#include "tools/view/run_states.hpp"

namespace waitpoint::tools::view {
namespace {

// A copy goes on in windows, between which it looks if it is still wanted.
constexpr Duration window = std::chrono::seconds(1);
constexpr std::size_t frames_of_stack = 64;
constexpr std::int64_t points_max = 100'000, points_usual = 1'000, events_max = 1'000'000;

/// "function at file:line" in its parts.
Json frame_of_stack(const std::string& line) {
  const std::size_t at = line.rfind(" at "), colon = line.rfind(':');
  if (at == std::string::npos || colon == std::string::npos || colon < at) return {{"function", line}};
  constexpr std::size_t word = 4;
  return {{"function", line.substr(0, at)},
          {"file", line.substr(at + word, colon - at - word)},
          {"line", std::atoi(line.c_str() + colon + 1)}};
}

}  // namespace

Channel RunCopy::fork() const {
  auto [here, there] = Channel::make();
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "a copy of the run");
  if (child > 0) return std::move(here);
  here = Channel(Descriptor());
  RunCopy copy(*this);
  copy.serve(std::move(there));
}

// The outputs are the run's, and so is the interruption by the terminal; the copy ends with its channel.
void RunCopy::serve(Channel channel) {
  kernel::set_post_mortem(nullptr);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGCHLD, SIG_IGN);
  make_files_private(channel.number());
  experiment_.set_observer([this](Time time) { counts_.take(time); });
  kernel::set_watch(experiment_.simulation().scheduler(), nullptr);
  for (const auto& robot : experiment_.robots()) robot->set_watch(nullptr);
  channel_ = &channel;
  answer_requests();
  _exit(0);
}

void RunCopy::answer_requests() {
  while (const auto message = channel_->receive()) {
    std::string reply;
    try {
      const Json request = Json::parse(message->text);
      if (request.at("do") == "fork") {
        const Channel copy = fork();
        channel_->send(fmt::format("{{\"time\":{},\"events\":{}}}", now().ns(), experiment_.events()), copy.number());
        continue;
      }
      reply = answer(request);
    } catch (const std::exception& failure) {
      reply = text_of(Json{{"error", failure.what()}, {"time", now().ns()}});
    }
    channel_->send(reply);
  }
}

std::string RunCopy::answer(const Json& request) {
  const std::string what = request.at("do");
  line_ = request.value("line", 0);
  if (what == "to") {
    go_to(time_in(request, "time") + Duration::from_ns(1));
    return floor(request);
  }
  if (what == "look") return floor(request);
  if (what == "to_event") return to_event(request);
  if (what == "event_before") return event_before(request);
  if (what == "events_so_far") return text_of({{"events", experiment_.events()}});
  if (what == "step") return step(request);
  if (what == "tasks") return text_of(task_states(experiment_));
  if (what == "modules") return text_of(module_states(experiment_, robot_in(request)));
  if (what == "events") return events(request);
  if (what == "plot") return plot(request);
  if (what == "stack") return stack(request);
  if (what == "digests") return digests(request);
  if (what == "intervene") return intervene(request);
  if (what == "counts") {
    if (request.contains("time")) go_to(time_in(request, "time") + Duration::from_ns(1));
    return counts_.text();
  }
  if (what == "journal") return journal();
  throw BadInput("the view", "there is no request '" + what + "'");
}

std::size_t RunCopy::robot_in(const Json& request) const {
  const auto last = static_cast<std::int64_t>(experiment_.robots().size()) - 1;
  return static_cast<std::size_t>(whole_number_in(request, "robot", 0, last));
}

std::string RunCopy::floor(const Json& request, const Json& more) {
  FrameOptions options = frame_options(request, experiment_.robots().size());
  options.line = line_;
  options.whole = true;
  const std::string text = frames_.read(now(), options);
  return text + (more.empty() ? "}" : "," + text_of(more).substr(1));
}

// The instant that the copy stands at: between two events of it, or at the end of the requested span.
Time RunCopy::now() const {
  if (is_over_ || experiment_.paused()) return experiment_.simulation().global_time();
  return std::max(reached_ - Duration::from_ns(1), Time());
}

// All events before `time`.
void RunCopy::go_to(Time time) {
  while (!is_over_ && reached_ < time) {
    go_on(std::min(time, reached_ + window));
    if (!channel_->is_wanted()) _exit(0);
  }
}

RunEnd RunCopy::go_on(Time time, const std::function<bool(const kernel::EventRecord&)>& enough) {
  const RunEnd end = enough ? experiment_.run_before(time, enough) : experiment_.run_before(time);
  is_over_ = end != RunEnd::time_reached;
  if (!experiment_.paused()) reached_ = std::max(reached_, time);
  return end;
}

// An event that is looked for may never come: a run may have no end.
bool RunCopy::may_search(Time until) const {
  constexpr Duration ahead = std::chrono::minutes(1);
  return !is_over_ && reached_ < until + ahead && channel_->is_wanted();
}

std::string RunCopy::step(const Json& request) {
  const auto count = static_cast<std::uint64_t>(whole_number_in(request, "count", 0, INT64_MAX, 1));
  const std::int64_t task = whole_number_in(request, "task", 0, UINT32_MAX, -1);
  const Time until = std::max(time_in(request, "until"), reached_);
  std::uint64_t seen = 0, all = experiment_.events();
  Json event = nullptr;
  const auto enough = [&](const kernel::EventRecord& record) {
    ++all;
    if (task >= 0 && record.task->number != task) return false;
    if (++seen < count) return false;
    event = {{"number", all}, {"time", record.time.ns()}, {"task", record.task->number}, {"text", event_text(record)}};
    return true;
  };
  while (event.is_null() && may_search(until)) go_on(reached_ + window, enough);
  return floor(request, {{"event", event}});
}

std::string RunCopy::to_event(const Json& request) {
  const std::uint64_t event = request.at("event");
  std::uint64_t seen = experiment_.events();
  while (seen < event && !is_over_ && channel_->is_wanted())
    go_on(reached_ + window, [&](const kernel::EventRecord&) { return ++seen == event; });
  return floor(request);
}

// 0: there is none.
std::string RunCopy::event_before(const Json& request) {
  const std::uint64_t last = request.at("event"), count = request.at("count");
  const std::int64_t task = whole_number_in(request, "task", 0, UINT32_MAX);
  std::uint64_t seen = experiment_.events();
  std::deque<std::uint64_t> numbers;
  while (seen < last && !is_over_ && channel_->is_wanted())
    go_on(reached_ + window, [&](const kernel::EventRecord& record) {
      ++seen;
      if (record.task->number == task) numbers.push_back(seen);
      if (numbers.size() > count + 1) numbers.pop_front();
      return seen == last;
    });
  return text_of({{"event", numbers.size() > count ? numbers.front() : 0}});
}

std::string RunCopy::events(const Json& request) {
  const Time from = time_in(request, "from"), to = time_in(request, "to");
  const auto most = static_cast<std::size_t>(whole_number_in(request, "most", 0, events_max, events_max));
  go_to(from);
  const EventTrace trace(experiment_.simulation().scheduler(), most);
  constexpr std::int64_t parts = 256;
  const Duration part = std::max(Duration::from_ns(1), (to - from) / parts);
  for (Time at = from; at < to && trace.is_complete(); at = std::min(to, at + part)) {
    if (go_on(std::min(to, at + part)) != RunEnd::time_reached) break;
    if (!channel_->is_wanted()) _exit(0);
  }
  return trace.text(from, to);
}

std::string RunCopy::plot(const Json& request) {
  const std::size_t robot = robot_in(request);
  const std::string name = request.at("poster"), field = request.at("field");
  const genom::PosterBase* const poster = experiment_.robots()[robot]->names().find_poster(name);
  if (poster == nullptr || !poster->has_number(field))
    throw BadInput("the view", "there is no number '" + field + "' of a poster '" + name + "'");
  const Time from = time_in(request, "from"), to = time_in(request, "to");
  const std::int64_t points = whole_number_in(request, "points", 1, points_max, points_usual);
  const Duration step = std::max(Duration::from_ns(1), (to - from) / points);
  std::string times, values;
  for (Time at = from; at <= to; at = at + step) {
    go_to(at);
    if (is_over_) break;
    FieldReading reading{field};
    Time date;
    const bool is_number =
        poster->look_numbers({&reading, 1}, date) == genom::PosterStatus::ok && reading.outcome == FieldOutcome::number;
    times += fmt::format("{}{}", times.empty() ? "" : ",", at.ns());
    if (!values.empty()) values += ',';
    values += is_number && std::isfinite(reading.number) ? fmt::format("{:.9g}", reading.number) : "null";
  }
  return "{\"t\":[" + times + "],\"v\":[" + values + "]}";
}

std::string RunCopy::stack(const Json& request) {
  const auto last = static_cast<std::uint64_t>(whole_number_in(request, "event", 1, INT64_MAX));
  const Time until = time_in(request, "until");
  std::uint64_t seen = experiment_.events();
  if (last <= seen) throw BadInput("the view", "expected an event after this instant");
  sync::ReturnAddresses addresses(frames_of_stack);
  std::string task;
  const auto enough = [&](const kernel::EventRecord& record) {
    if (++seen < last) return false;
    task = std::string(record.task->name) + " of " + record.task->robot->name;
    addresses.resize(kernel::capture_call_stack(addresses.data(), addresses.size()));
    return true;
  };
  while (task.empty() && may_search(until)) go_on(reached_ + window, enough);
  if (task.empty()) throw BadInput("the view", "the run has not come to this event");
  const sync::ReturnAddresses stacks[] = {addresses};
  Json frames = Json::array();
  const std::vector<std::vector<std::string>> lines = sync::user_source_lines(stacks, frames_of_stack);
  // The innermost frames are of the observer that stopped the run.
  const auto is_observer = [](const std::string& line) {
    return line.find("view/history/run_copy.cpp") != std::string::npos ||
           line.find("PauseWatch::") != std::string::npos;
  };
  bool is_inside = true;
  for (const std::string& line : lines.front())
    if (!(is_inside = is_inside && is_observer(line))) frames.push_back(frame_of_stack(line));
  return text_of({{"task", task}, {"event", last}, {"frames", frames}});
}

std::string RunCopy::digests(const Json& request) {
  Json list = Json::array();
  for (const Json& time : request.at("times")) {
    go_to(time_of(time, "times"));
    list.push_back(to_string(experiment_.simulation().digest()));
  }
  return text_of({{"digests", list}});
}

std::string RunCopy::intervene(const Json& request) {
  const run::Intervention intervention =
      run::parse_intervention(request.at("text").get<std::string>(), {"the view", 0});
  const Time date = experiment_.intervene(
      intervention, request.contains("date") ? std::optional(time_in(request, "date")) : std::nullopt);
  interventions_.push_back({date, run::to_text(date, intervention)});
  return text_of({{"date", date.ns()}});
}

// Those of a line of time that this copy has not come to are not part of it.
std::string RunCopy::journal() const {
  const run::JournalEnd here{now(), experiment_.events(), to_string(experiment_.simulation().digest())};
  std::string text = journal_;
  for (const auto& [date, line] : interventions_)
    if (date <= now() + experiment_.world().description().step) text += line;
  Json outcomes = Json::array();
  for (const run::InterventionOutcome& outcome : experiment_.outcomes())
    outcomes.push_back({{"time", outcome.date.ns()}, {"text", outcome.of + ": " + outcome.text}});
  return text_of({{"text", text + run::to_text(here)}, {"outcomes", outcomes}});
}

}  // namespace waitpoint::tools::view
