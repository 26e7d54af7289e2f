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
              "its end is the plan's choice, or its request's report")
          .add("duration_s", duration_schema, "seconds, or `[least, greatest]`")
          .add("request", dotted_schema, "`MODULE.NAME`, which it calls")
          .add("input", input_schema, "of the request: `start`, or a map of fields")
          .add("tcl", text_form().schema, "`PROCEDURE ARGUMENT ...` of the robot's script")
          .add("stop", dotted_schema, "the request that ends it")
          .add("rendezvous", text_form().schema, "a meeting with another robot")
          .add("when", list_of(condition_keys()), "conditions of its start")
          .add("during", list_of(condition_keys()), "conditions until its end")
          .add("uses", uses_schema, "amounts of resources")
          .add("after", names_schema, "actions that end before it starts")
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
               "period at which conditions are looked at")
          .add("setup", requests_schema, "requests before the plan")
          .add("ready", list_of(condition_keys()), "conditions of the plan's start")
          .add("resources", list_of(resource_keys()), "what actions use")
          .add("actions", actions_schema, "the actions", Need::required)
          .add("constraints", list_of(constraint_keys()), "times between starts and ends of actions")
          .add("alternatives", list_of(alternative_keys()), "branches, of which one is executed")
          .add("safe", requests_schema, "requests when the plan fails")
          .add("done", requests_schema, "requests at its end");
  return keys;
}

}  // namespace waitpoint::plan
