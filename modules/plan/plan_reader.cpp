// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/plan_reader.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "modules/plan/plan_keys.hpp"
#include "modules/scenario/robot_reader.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::plan {

using scenario::YamlMap;
using scenario::YamlNode;

namespace {

Duration read_seconds(const YamlNode& node, const std::string& what, bool is_signed = false) {
  Duration duration;
  const bool is_time = node.kind == YamlNode::Kind::scalar && !node.quoted && parse_seconds(node.text, duration);
  if (is_time && (is_signed || duration >= Duration())) return duration;
  throw node.written.bad("expected " + what + " to be seconds from " + (is_signed ? "-1000000" : "0") +
                         " to 1000000 with at most nine decimals, found " + described(node));
}

/// "MODULE.NAME" as two names.
std::pair<std::string, std::string> read_dotted(const YamlNode& node, const std::string& what) {
  const std::string text = read_text(node, what);
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == text.size())
    throw node.written.bad("expected " + what + " to be MODULE.NAME, found '" + text + "'");
  return {text.substr(0, dot), text.substr(dot + 1)};
}

Request read_request(const YamlNode& name, const YamlNode* input) {
  Request request;
  request.written = name.written;
  std::tie(request.module, request.name) = read_dotted(name, "a request");
  if (input == nullptr) return request;
  request.takes_start = input->kind == YamlNode::Kind::scalar && input->text == "start";
  if (!request.takes_start && input->kind != YamlNode::Kind::map)
    throw input->written.bad("expected input to be 'start' or a map of fields, found " + described(*input));
  if (!request.takes_start) request.input = scenario::flattened(*input);
  return request;
}

/// "PROCEDURE ARGUMENT ...": a procedure of the robot's script.
Request read_call(const YamlNode& node) {
  const std::string text = read_text(node, "tcl");
  const std::size_t end = std::min(text.find(' '), text.size());
  if (end == 0) throw node.written.bad("expected tcl to be PROCEDURE ARGUMENT ..., found " + described(node));
  Request request;
  request.module = script_module;
  request.name = text.substr(0, end);
  request.written = node.written;
  if (end < text.size())
    request.input.push_back({"arguments", text.substr(end + 1), node.written.file, node.written.line});
  return request;
}

/// A list of "MODULE.NAME", of {request: MODULE.NAME, input: ...}, and of {tcl: PROCEDURE ARGUMENT ...}.
std::vector<Request> read_requests(const YamlMap& map, std::string_view key) {
  std::vector<Request> requests;
  const YamlNode* list = map.find(key);
  if (list == nullptr) return requests;
  for (const YamlNode& item : read_list(*list, key)) {
    if (item.kind == YamlNode::Kind::map && item.find("tcl") != nullptr) {
      requests.push_back(read_call(YamlMap(item, "a request", {"tcl"}).require("tcl")));
    } else if (item.kind == YamlNode::Kind::map) {
      const YamlMap request(item, "a request", request_keys().names());
      requests.push_back(read_request(request.require("request"), request.find("input")));
    } else {
      requests.push_back(read_request(item, nullptr));
    }
  }
  return requests;
}

std::vector<Condition> read_conditions(const YamlMap& map, std::string_view key) {
  std::vector<Condition> conditions;
  const YamlNode* list = map.find(key);
  if (list == nullptr) return conditions;
  for (const YamlNode& item : read_list(*list, key)) {
    const YamlMap row(item, "a condition", condition_keys().names());
    Condition& condition = conditions.emplace_back();
    condition.written = item.written;
    const auto [module, name] = read_dotted(row.require("poster"), "poster");
    condition.poster.append(module).append(".").append(name);
    condition.field = row.text("field", "");
    int comparisons = 0;
    for (const auto& [word, comparison] :
         {std::pair("at_least", Condition::Comparison::at_least), std::pair("at_most", Condition::Comparison::at_most),
          std::pair("equals", Condition::Comparison::equals)}) {
      if (!row.has(word)) continue;
      condition.comparison = comparison;
      condition.value = row.number(word, any_number);
      ++comparisons;
    }
    if (comparisons > 1 || (comparisons == 1) != !condition.field.empty())
      throw item.written.bad("expected a field with one of at_least, at_most and equals in a condition, or neither");
  }
  return conditions;
}

std::string read_name(const YamlMap& map, const std::string& what) {
  const YamlNode& node = map.require("name");
  std::string name = read_text(node, "name");
  constexpr std::size_t letters_max = 40;
  if (name.size() > letters_max || name.find('.') != std::string::npos || name == "start")
    throw node.written.bad("expected the name of " + what +
                           " to have at most 40 letters, no dot, and not to be 'start', found '" + name + "'");
  return name;
}

/// The index of the element of that name in `known`; BadInput at `written` if there is none.
template <class Named>
std::size_t find(const std::vector<Named>& known, const std::string& name, const std::string& what,
                 const scenario::Location& written) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].name == name) return i;
    names.push_back(known[i].name);
  }
  throw written.bad("there is no " + what + " '" + name + "'" + did_you_mean_or_expected(name, names));
}

template <class Named>
void check_new(const std::vector<Named>& known, const std::string& name, const std::string& what,
               const scenario::Location& written) {
  if (std::any_of(known.begin(), known.end(), [&](const Named& other) { return other.name == name; }))
    throw written.bad("there are two " + what + "s called '" + name + "'");
}

void read_resources(const YamlMap& map, TemporalPlan& plan) {
  const YamlNode* list = map.find("resources");
  if (list == nullptr) return;
  for (const YamlNode& item : read_list(*list, "resources")) {
    const YamlMap row(item, "a resource", resource_keys().names());
    Resource resource{read_name(row, "a resource"), 1, item.written};
    row.read("capacity", resource.capacity, 1, amount_max);
    check_new(plan.resources, resource.name, "resource", item.written);
    plan.resources.push_back(std::move(resource));
  }
}

void read_duration(const YamlMap& row, Action& action) {
  const YamlNode* node = row.find("duration_s");
  if (node == nullptr) {
    if (action.contingent) throw row.node().written.bad("expected key 'duration_s' in " + row.what());
    return;
  }
  if (node->kind == YamlNode::Kind::scalar) {
    action.least = action.most = read_seconds(*node, "duration_s");
    return;
  }
  if (node->kind != YamlNode::Kind::list || node->items.size() != 2)
    throw node->written.bad("expected duration_s to be seconds or [least, greatest], found " + described(*node));
  action.least = read_seconds(node->items[0], "the least duration");
  action.most = read_seconds(node->items[1], "the greatest duration");
  if (action.most < action.least) throw node->written.bad("expected the least duration before the greatest");
}

void read_uses(const YamlMap& row, const TemporalPlan& plan, Action& action) {
  const YamlNode* uses = row.find("uses");
  if (uses == nullptr) return;
  if (uses->kind != YamlNode::Kind::map)
    throw uses->written.bad("expected uses to be a map of resources and amounts, found " + described(*uses));
  for (const scenario::YamlEntry& entry : uses->entries) {
    const std::size_t resource = find(plan.resources, entry.key, "resource", entry.written);
    const std::uint32_t capacity = plan.resources[resource].capacity;
    action.uses.push_back(
        {resource, static_cast<std::uint32_t>(read_count(entry.value, "the amount of " + entry.key, 1, capacity))});
  }
}

void read_action(const YamlNode& item, TemporalPlan& plan) {
  const std::string title = name_of(item).empty() ? "an action" : "action '" + std::string(name_of(item)) + "'";
  const YamlMap row(item, title, action_keys().names());
  Action action;
  action.name = read_name(row, "an action");
  action.written = item.written;
  check_new(plan.actions, action.name, "action", item.written);
  const int ends = row.has("request") + row.has("tcl") + row.has("rendezvous");
  action.contingent = row.one_of("kind", action_kinds, row.has("rendezvous") ? 1 : 0) == 1;
  read_duration(row, action);
  if (const YamlNode* request = row.find("request")) action.request = read_request(*request, row.find("input"));
  if (const YamlNode* call = row.find("tcl")) action.request = read_call(*call);
  if (const YamlNode* stop = row.find("stop")) action.stop = read_request(*stop, nullptr);
  action.rendezvous = row.text("rendezvous", "");
  if (ends > 1)
    throw item.written.bad("expected a request, a procedure or a rendezvous in " + title + ", found several");
  if (row.has("input") && !row.has("request"))
    throw item.written.bad("expected no input without a request in " + title);
  if (row.has("rendezvous") && !action.contingent)
    throw item.written.bad("expected a rendezvous to be contingent: its end is the other robot's choice");
  if (action.contingent && ends == 0)
    throw item.written.bad("expected a request, a procedure or a rendezvous in " + title +
                           ": a contingent action ends with its report");
  action.when = read_conditions(row, "when");
  action.during = read_conditions(row, "during");
  read_uses(row, plan, action);
  plan.actions.push_back(std::move(action));
}

// "after: visit", "after: [visit, wait]": ends before this start.
void read_after(const YamlNode& item, std::size_t action, TemporalPlan& plan) {
  const YamlNode* after = item.find("after");
  if (after == nullptr) return;
  const auto add = [&](const YamlNode& name) {
    const std::string other = read_text(name, "after");
    const std::size_t before = find(plan.actions, other, "action", name.written);
    plan.constraints.push_back({plan.actions[action].name + " after " + other, end_of(before), start_of(action),
                                Duration(), std::nullopt, name.written});
  };
  if (after->kind == YamlNode::Kind::list)
    for (const YamlNode& name : after->items) add(name);
  else
    add(*after);
}

// The script's task evaluates one procedure at a time.
void share_script(TemporalPlan& plan) {
  const auto calls = [](const Action& action) { return action.request && action.request->is_to_script(); };
  if (std::none_of(plan.actions.begin(), plan.actions.end(), calls)) return;
  for (Action& action : plan.actions)
    if (calls(action)) action.uses.push_back({plan.resources.size(), 1});
  plan.resources.push_back({"the task of the script", 1, plan.actions.front().written});
}

PointId read_point(const YamlMap& row, std::string_view key, const TemporalPlan& plan) {
  const YamlNode& node = row.require(key);
  const std::string text = read_text(node, key);
  if (text == "start") return origin;
  const std::size_t dot = text.rfind('.');
  const std::string side = dot == std::string::npos ? "" : text.substr(dot + 1);
  if (side != "start" && side != "end")
    throw node.written.bad("expected " + std::string(key) + " to be start, ACTION.start or ACTION.end, found '" + text +
                           "'");
  const std::size_t action = find(plan.actions, text.substr(0, dot), "action", node.written);
  return side == "start" ? start_of(action) : end_of(action);
}

void read_constraints(const YamlMap& map, TemporalPlan& plan) {
  const YamlNode* list = map.find("constraints");
  if (list == nullptr) return;
  for (const YamlNode& item : read_list(*list, "constraints")) {
    const YamlMap row(item, "a constraint", constraint_keys().names());
    Constraint constraint;
    constraint.written = item.written;
    constraint.from = read_point(row, "from", plan);
    constraint.to = read_point(row, "to", plan);
    constraint.name = row.text("name", row.text("from") + " to " + row.text("to"));
    if (const YamlNode* least = row.find("least_s")) constraint.least = read_seconds(*least, "least_s", true);
    if (const YamlNode* most = row.find("most_s")) constraint.most = read_seconds(*most, "most_s", true);
    if (!constraint.least && !constraint.most)
      throw item.written.bad("expected key 'least_s' or 'most_s' in a constraint");
    if (constraint.from == constraint.to) throw item.written.bad("expected a constraint between two points, found one");
    plan.constraints.push_back(std::move(constraint));
  }
}

void read_branch(const YamlNode& branch, const Alternative& alternative, TemporalPlan& plan) {
  for (const YamlNode& item : read_list(branch, "a branch")) {
    Action& action = plan.actions[find(plan.actions, read_text(item, "an action of a branch"), "action", item.written)];
    if (action.alternative) throw item.written.bad("action '" + action.name + "' is in two branches");
    action.alternative = plan.alternatives.size();
    action.branch = alternative.branches;
  }
}

void read_alternatives(const YamlMap& map, TemporalPlan& plan) {
  const YamlNode* list = map.find("alternatives");
  if (list == nullptr) return;
  for (const YamlNode& item : read_list(*list, "alternatives")) {
    const YamlMap row(item, "an alternative", alternative_keys().names());
    Alternative alternative{read_name(row, "an alternative"), 0};
    check_new(plan.alternatives, alternative.name, "alternative", item.written);
    for (const YamlNode& branch : read_list(row.require("branches"), "branches")) {
      read_branch(branch, alternative, plan);
      ++alternative.branches;
    }
    if (alternative.branches == 0) throw item.written.bad("expected at least one branch in an alternative");
    plan.alternatives.push_back(std::move(alternative));
  }
}

}  // namespace

bool parse_seconds(std::string_view text, Duration& duration) {
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  const std::size_t dot = text.find('.');
  const std::string_view whole = text.substr(0, dot);
  std::string decimals(dot == text.npos ? "0" : text.substr(dot + 1));
  constexpr std::size_t places = 9;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (decimals.empty() || decimals.size() > places || whole.empty() || whole.size() > places ||
      !std::all_of(whole.begin(), whole.end(), is_digit) || !std::all_of(decimals.begin(), decimals.end(), is_digit))
    return false;
  decimals.resize(places, '0');
  std::int64_t seconds = 0, ns = 0;
  if (!parse_number(whole, seconds) || !parse_number(std::string_view(decimals), ns)) return false;
  const Duration parsed = Duration(std::chrono::seconds(seconds)) + Duration::from_ns(ns);
  if (parsed > bound_max) return false;
  duration = is_negative ? -parsed : parsed;
  return true;
}

TemporalPlan read_plan(const YamlNode& document) {
  const YamlMap map(document, "the plan", plan_keys().names());
  read_count(map.require("format"), "format", 1, 1);
  TemporalPlan plan;
  plan.file = document.written.file;
  plan.name = map.text("name");
  map.read("poll_ms", plan.poll, std::chrono::milliseconds(1));
  plan.setup = read_requests(map, "setup");
  plan.ready = read_conditions(map, "ready");
  read_resources(map, plan);
  const YamlNode& actions = map.require("actions");
  if (const std::size_t count = read_list(actions, "actions").size(); count == 0 || count > actions_max)
    throw actions.written.bad("expected 1 to " + std::to_string(actions_max) + " actions, found " +
                              std::to_string(count));
  for (const YamlNode& item : actions.items) read_action(item, plan);
  share_script(plan);
  for (std::size_t i = 0; i < plan.actions.size(); ++i) read_after(actions.items[i], i, plan);
  read_constraints(map, plan);
  read_alternatives(map, plan);
  plan.safe = read_requests(map, "safe");
  plan.done = read_requests(map, "done");
  return plan;
}

}  // namespace waitpoint::plan
