// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/plan_keys.hpp"

namespace waitpoint::plan {
namespace {

using scenario::any_of;
using scenario::Json;
using scenario::KeyTable;
using scenario::list_of;
using scenario::list_schema;
using scenario::Need;
using scenario::needed;
using scenario::number_form;
using scenario::SchemaDefinitions;
using scenario::text_form;

Json format_schema(SchemaDefinitions&) { return {{"const", 1}}; }

Json seconds_schema(SchemaDefinitions&) { return {{"type", "number"}, {"minimum", 0}, {"maximum", 1'000'000}}; }
Json signed_seconds_schema(SchemaDefinitions&) {
  return {{"type", "number"}, {"minimum", -1'000'000}, {"maximum", 1'000'000}};
}

Json duration_schema(SchemaDefinitions& definitions) {
  Json ends = list_schema(seconds_schema(definitions), 2);
  ends["maxItems"] = 2;
  return any_of({seconds_schema(definitions), ends});
}

Json dotted_schema(SchemaDefinitions&) { return {{"type", "string"}, {"pattern", "^[^.]+[.]."}}; }

Json name_schema(SchemaDefinitions&) {
  Json schema = scenario::text_schema();
  schema["pattern"] = "^[^.]{1,40}$";
  schema["not"] = {{"const", "start"}};
  return schema;
}

Json input_schema(SchemaDefinitions&) { return any_of({{{"const", "start"}}, {{"type", "object"}}}); }

Json requests_schema(SchemaDefinitions& definitions) {
  const Json call = {{"type", "object"},
                     {"properties", {{"tcl", scenario::text_schema()}}},
                     {"required", {"tcl"}},
                     {"additionalProperties", false}};
  return list_schema(any_of({dotted_schema(definitions), request_keys().schema(definitions), call}));
}

Json uses_schema(SchemaDefinitions&) { return scenario::map_schema(scenario::count_schema({1, amount_max})); }

Json names_schema(SchemaDefinitions&) {
  return any_of({scenario::text_schema(), list_schema(scenario::text_schema())});
}

Json point_schema(SchemaDefinitions&) { return {{"type", "string"}, {"pattern", "^start$|[.](start|end)$"}}; }

Json branches_schema(SchemaDefinitions&) { return list_schema(list_schema(scenario::text_schema()), 1); }

Json actions_schema(SchemaDefinitions& definitions) {
  Json schema = list_schema(action_keys().schema(definitions), 1);
  schema["maxItems"] = actions_max;
  return schema;
}

Json at_most_one(std::initializer_list<const char*> keys) {
  Json pairs = Json::array();
  for (auto first = keys.begin(); first != keys.end(); ++first)
    for (auto second = first + 1; second != keys.end(); ++second) pairs.push_back(needed({*first, *second}));
  return {{"not", {{"anyOf", pairs}}}};
}

}  // namespace

const KeyTable& request_keys() {
  static const KeyTable keys =
      KeyTable("request")
          .add("request", dotted_schema, "`MODULE.NAME`", Need::required)
          .add("input", input_schema, "`start`, the robot's start, or a map of the input's fields");
  return keys;
}

const KeyTable& condition_keys() {
  static const Json compared = {{"anyOf", {needed({"at_least"}), needed({"at_most"}), needed({"equals"})}}};
  static const KeyTable keys = KeyTable("condition")
                                   .add("poster", dotted_schema, "`MODULE.POSTER`", Need::required)
                                   .add("field", text_form().schema, "a number of it")
                                   .add("at_least", number_form(any_number).schema, "bound of the field")
                                   .add("at_most", number_form(any_number).schema, "bound of the field")
                                   .add("equals", number_form(any_number).schema, "the field's value")
                                   .require(at_most_one({"at_least", "at_most", "equals"}))
                                   .require({{"if", needed({"field"})}, {"then", compared}})
                                   .require({{"if", compared}, {"then", needed({"field"})}});
  return keys;
}

const KeyTable& resource_keys() {
  static const KeyTable keys =
      KeyTable("resource")
          .add("name", name_schema, "its name", Need::required)
          .add("capacity", scenario::count_form<std::uint64_t>({1, amount_max}).schema, "amount there is");
  return keys;
}

const KeyTable& action_keys() {
  static const KeyTable keys =
      KeyTable("action")
          .add("name", name_schema, "its name", Need::required)
          .add(
              "kind", [](SchemaDefinitions&) { return scenario::word_schema(action_kinds); },
              "`controllable`: the executor ends it, at the first time that the constraints allow; `contingent`: its "
              "request's final report ends it")
          .add("duration_s", duration_schema, "seconds, or `[least, greatest]`")
          .add("request", dotted_schema, "`MODULE.REQUEST`, sent at its start")
          .add("input", input_schema, "the request's input by field, or `start`: the robot's known pose")
          .add("tcl", text_form().schema,
               "`PROCEDURE ARGUMENT ...`: a procedure of the robot's script, in place of a request")
          .add("stop", dotted_schema, "a request sent at its end by the executor, in place of an abort of the activity")
          .add("rendezvous", text_form().schema,
               "another robot, whose plan has a rendezvous of the same name with this one: both wait for each other, "
               "over the scenario's `medium`, by the module `meeting`")
          .add("when", list_of(condition_keys()), "conditions on posters for which its start waits")
          .add("during", list_of(condition_keys()), "conditions on posters; it fails when one does not hold")
          .add("uses", uses_schema, "amounts of resources: `{base: 1}`")
          .add("after", names_schema, "an action or a list: it starts after their ends")
          .require(at_most_one({"request", "tcl", "rendezvous"}))
          .require({{"if", needed({"input"})}, {"then", needed({"request"})}})
          .require({{"if",
                     {{"anyOf",
                       {needed({"rendezvous"}),
                        {{"properties", {{"kind", {{"const", "contingent"}}}}}, {"required", {"kind"}}}}}}},
                    {"then",
                     {{"allOf", {needed({"duration_s"})}},
                      {"properties", {{"kind", {{"enum", {"contingent", nullptr}}}}}},
                      {"anyOf", {needed({"request"}), needed({"tcl"}), needed({"rendezvous"})}}}}});
  return keys;
}

const KeyTable& constraint_keys() {
  static const KeyTable keys = KeyTable("constraint")
                                   .add("name", text_form().schema, "its name in messages")
                                   .add("from", point_schema, "`start`, `ACTION.start` or `ACTION.end`", Need::required)
                                   .add("to", point_schema, "the same", Need::required)
                                   .add("least_s", signed_seconds_schema, "least time between them")
                                   .add("most_s", signed_seconds_schema, "greatest time between them")
                                   .require({{"anyOf", {needed({"least_s"}), needed({"most_s"})}}});
  return keys;
}

const KeyTable& alternative_keys() {
  static const KeyTable keys =
      KeyTable("alternative")
          .add("name", name_schema, "its name", Need::required)
          .add("branches", branches_schema, "lists of actions, of which one is executed", Need::required);
  return keys;
}

const KeyTable& plan_keys() {
  static const KeyTable keys =
      KeyTable("plan")
          .add("format", format_schema, "the version of the format", Need::required)
          .add("name", text_form().schema, "its name", Need::required)
          .add(
              "description", [](SchemaDefinitions&) { return Json::object(); }, "for people")
          .add("poll_ms", scenario::duration_form(std::chrono::milliseconds(1)).schema,
               "period of looks at the posters of conditions")
          .add("setup", requests_schema, "requests sent in order before the plan's start, each until its first reply")
          .add("ready", list_of(condition_keys()), "conditions for which the plan's start waits")
          .add("resources", list_of(resource_keys()), "a list of `{name, capacity}`")
          .add("actions", actions_schema, "the list of actions, at most 200", Need::required)
          .add("constraints", list_of(constraint_keys()),
               "a list of `{name, from, to, least_s, most_s}`: bounds on `to - from`, each a point: `start` (of the "
               "plan), `ACTION.start`, `ACTION.end`")
          .add("alternatives", list_of(alternative_keys()),
               "a list of `{name, branches: [[ACTION, ...], ...]}`: the first branch is planned, the next ones replace "
               "it after a failure; `[]` is a branch without actions")
          .add("safe", requests_schema, "requests, or `{tcl: PROCEDURE ...}`, sent in order after an abort")
          .add("done", requests_schema, "requests, or `{tcl: PROCEDURE ...}`, sent in order after the last action");
  return keys;
}

}  // namespace waitpoint::plan
