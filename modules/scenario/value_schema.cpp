// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/value_schema.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::scenario {
namespace {

/// What `whole` demands of a value for which `part` holds; an empty object: nothing.
Json beyond(const Json& whole, const Json& part) {
  if (!whole.is_object() || !part.is_object()) return whole;
  Json more = Json::object();
  for (const auto& [key, value] : whole.items()) {
    const auto same = part.find(key);
    if (key == "description" || key == "default" || (same != part.end() && *same == value)) continue;
    if (key == "items" && same != part.end()) {
      more[key] = beyond(value, *same);
    } else if (key == "properties" && same != part.end()) {
      for (const auto& [name, property] : value.items())
        if (Json each = same->contains(name) ? beyond(property, (*same)[name]) : property; !each.empty())
          more[key][name] = std::move(each);
    } else {
      more[key] = value;
    }
  }
  // These mean something together.
  if (more.contains("if") || more.contains("then") || more.contains("else"))
    for (const char* key : {"if", "then", "else"})
      if (whole.contains(key)) more[key] = whole[key];
  return more;
}

Json reference_to(const std::string& key) { return {{"$ref", "#/$defs/" + key}}; }

}  // namespace

Json SchemaDefinitions::reference(const std::string& name, const std::function<Json(SchemaDefinitions&)>& make) {
  std::string key = name;
  std::replace(key.begin(), key.end(), ' ', '_');
  if (const auto [at, is_new] = complete_.emplace(key, key); is_new) {
    made_[key] = made_by(true, make);
    Json complete = reference_to(key);
    complete.update(beyond(made_by(false, make), made_[key]));
    if (complete.size() > 1) made_[at->second = "complete_" + key] = std::move(complete);
  }
  return reference_to(is_partial_ ? key : complete_[key]);
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

Json described(std::string_view text, const Json& schema) {
  Json all = {{"description", text}};
  all.update(schema);
  return all;
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
