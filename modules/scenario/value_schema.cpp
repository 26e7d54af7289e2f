// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/value_schema.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::scenario {

Json SchemaDefinitions::reference(const std::string& name, const std::function<Json()>& make) {
  const std::string full = is_partial_ ? "part of " + name : name;
  std::string key = full;
  std::replace(key.begin(), key.end(), ' ', '_');
  if (const auto [at, is_new] = made_.emplace(key, nullptr); is_new) {
    Json schema = make();
    made_[key] = std::move(schema);
  }
  return {{"$ref", "#/$defs/" + key}};
}

Json SchemaDefinitions::part(const std::function<Json(SchemaDefinitions&)>& make) { return made_by(true, make); }

Json SchemaDefinitions::whole(const std::function<Json(SchemaDefinitions&)>& make) { return made_by(false, make); }

Json SchemaDefinitions::made_by(bool is_partial, const std::function<Json(SchemaDefinitions&)>& make) {
  const bool before = std::exchange(is_partial_, is_partial);
  Json schema = make(*this);
  is_partial_ = before;
  return schema;
}

Json number_schema(const NumberRange& range) {
  const bool has_hole = range.least > least_nonzero && range.low < range.least;
  if (!has_hole) return {{"type", "number"}, {"minimum", range.low}, {"maximum", range.high}};
  Json choices = {{{"const", 0}}, {{"minimum", range.least}, {"maximum", range.high}}};
  if (range.low < 0) choices.push_back({{"minimum", range.low}, {"maximum", -range.least}});
  return {{"type", "number"}, {"anyOf", choices}};
}

Json duration_schema(Duration unit) {
  constexpr double least_s = 1e-6;
  return {{"type", "number"}, {"minimum", std::max(1e-6, least_s / unit.seconds())}, {"maximum", 1e9}};
}

Json count_schema(const CountRange& range) {
  return {{"type", "integer"}, {"minimum", range.low}, {"maximum", range.high}};
}

Json truth_schema() { return {{"type", "boolean"}}; }

Json text_schema() { return {{"type", {"string", "number", "boolean"}}, {"minLength", 1}}; }

Json word_schema(std::span<const std::string_view> words) {
  Json list = Json::array();
  for (const std::string_view word : words) list.push_back(word);
  return {{"enum", list}};
}

Json list_schema(Json item, std::size_t size_min) {
  Json schema = {{"type", "array"}, {"items", std::move(item)}};
  if (size_min > 0) schema["minItems"] = size_min;
  return schema;
}

Json numbers_schema(const NumberRange& range, std::size_t size_min, std::size_t size_max) {
  Json schema = list_schema(number_schema(range), size_min);
  schema["maxItems"] = size_max;
  return schema;
}

Json map_schema(Json value) { return {{"type", "object"}, {"additionalProperties", std::move(value)}}; }

Json any_of(std::initializer_list<Json> schemas) {
  Json list = Json::array();
  for (const Json& schema : schemas) list.push_back(schema);
  return {{"anyOf", list}};
}

Json needed(std::initializer_list<const char*> keys) {
  Json list = Json::array(), values = Json::object();
  for (const char* key : keys) {
    list.push_back(key);
    values[key] = {{"not", {{"type", "null"}}}};
  }
  return {{"required", list}, {"properties", values}};
}

Json or_null(Json schema) {
  if (const auto type = schema.find("type"); type != schema.end() && !schema.contains("anyOf")) {
    if (!type->is_array()) *type = Json::array({*type});
    type->push_back("null");
    return schema;
  }
  if (schema.contains("enum")) {
    schema["enum"].push_back(nullptr);
    return schema;
  }
  if (schema.size() == 1 && schema.contains("anyOf")) {
    schema["anyOf"].push_back({{"type", "null"}});
    return schema;
  }
  return any_of({schema, {{"type", "null"}}});
}

}  // namespace waitpoint::scenario
